#include "coupling/workers/liggghts_session.hpp"

#include <fmt/format.h>
#include <liggghts/library.h>

#include <ctime>
#include <limits>
#include <unordered_map>

#include "coupling/workers/engine_errors.hpp"
#include "coupling/workers/fix_heartbeat.hpp"
#include "coupling/workers/fix_rotation.hpp"
#include "coupling/workers/liggghts_script.hpp"
#include "coupling/workers/register_fix.hpp"

namespace couloir {

namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

bool finite(const Vec& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

bool has_segment(const std::vector<DriveFace>& faces, int face, int segment) {
  return face >= 0 && face < static_cast<int>(faces.size()) && segment >= 0 &&
         segment < faces[static_cast<std::size_t>(face)].segments;
}

[[noreturn]] void refuse(const std::string& why) {
  throw EngineFailure(why, true);
}

[[noreturn]] void run_away(const std::string& how) {
  throw EngineFailure(how, true, true);
}

LAMMPS_NS::LAMMPS* open_engine(const std::string& log, MPI_Comm comm) {
  std::vector<std::string> words = {"liggghts", "-log", log, "-screen", "/dev/null", "-echo", "log"};  // "none" crashes at a mesh
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  void* engine = nullptr;
  lammps_open(static_cast<int>(argv.size()), argv.data(), comm, &engine);
  return static_cast<LAMMPS_NS::LAMMPS*>(engine);
}

}  // namespace

// from "Version LIGGGHTS-PUBLIC 3.8.0, compiled ..."
std::string Session::engine_name() const {
  const std::string text = engine_->universe->version;
  const std::size_t at = text.find("LIGGGHTS"), blank = text.find(' ', at), comma = text.find(',', at);
  return at == std::string::npos || blank == std::string::npos ? "LIGGGHTS" : "LIGGGHTS" + text.substr(blank, comma - blank);
}

Session::Session(const EngineSetup& setup, const std::string& checkpoint, MPI_Comm comm, std::function<void()> beat)
    : setup_(setup), comm_(comm) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  if (rank_ == 0) write_surfaces(setup);
  MPI_Barrier(comm);
  engine_ = open_engine(setup.work_dir + "/engine.log", comm);
  if (engine_->logfile) setvbuf(engine_->logfile, nullptr, _IOLBF, 0);  // its end must be readable after a crash
  register_fix<FixExchange>(engine_, "couloir/exchange");
  register_fix<FixDrive>(engine_, "couloir/drive");
  register_fix<FixForceProbe>(engine_, "couloir/probe");
  register_fix<FixZoneForce>(engine_, "couloir/zone_force");
  register_fix<FixHeartbeat>(engine_, "couloir/heartbeat");
  register_fix<FixRotation>(engine_, "couloir/rotation");
  SideFile side;
  if (!checkpoint.empty()) side = SideFile::read(checkpoint + ".drive", setup.faces);
  for (const std::string& line : liggghts_script(setup, side.grains > 0 ? checkpoint : "", side.step)) command(line);
  exchange_ = find_fix<FixExchange>(engine_, "exchange");
  drive_ = find_fix<FixDrive>(engine_, "drive");
  probe_ = find_fix<FixForceProbe>(engine_, "probe");
  zone_force_ = find_fix<FixZoneForce>(engine_, "zone_after");
  FixZoneForce* const zone_before = find_fix<FixZoneForce>(engine_, "zone_before");
  zone_before->watch(nullptr, &drive_->faces());
  zone_force_->watch(zone_before, &drive_->faces());
  std::vector<double*> counts;
  for (std::size_t k = 0; k < setup.surfaces.size(); ++k) counts.push_back(mesh_force(engine_, fmt::format("mesh_{}", k)));
  probe_->set_meshes(counts);
  find_fix<FixForceProbe>(engine_, "probe_before")->set_meshes(counts);
  if (setup.rotation != Rotation::free) {
    std::vector<LAMMPS_NS::FixMeshSurface*> surfaces;
    for (std::size_t k = 0; k < setup.surfaces.size(); ++k)
      surfaces.push_back(find_fix<LAMMPS_NS::FixMeshSurface>(engine_, fmt::format("mesh_{}", k)));
    find_fix<FixRotation>(engine_, "rotation")->set(setup, std::move(surfaces));
  }
  find_fix<FixHeartbeat>(engine_, "heartbeat")->beat = std::move(beat);
  drive_->set_faces(setup.faces, setup.max_radius);
  if (!checkpoint.empty()) take(side);
  command("run 0");
}

Session::~Session() {
  if (engine_) lammps_close(engine_);
}

void Session::command(const std::string& line) {
  lammps_command(engine_, line.c_str());
}

// Without its log: the engine would write a table for every window.
void Session::run(std::int64_t steps) {
  FILE* const log = engine_->logfile;
  engine_->logfile = nullptr;
  try {
    command(fmt::format("run {} pre no post no", steps));
  } catch (...) {
    engine_->logfile = log;
    throw;
  }
  engine_->logfile = log;
}

Advanced Session::advance(const AdvanceRequest& request) {
  const double cpu = cpu_seconds();
  check(request);
  check_ids(request);
  FixExchange::Order order{request.insert, {}, setup_.density, setup_.gravity};
  for (const std::int64_t id : request.remove) order.remove.push_back(static_cast<int>(id));
  std::sort(order.remove.begin(), order.remove.end());
  grains_ += static_cast<std::int64_t>(request.insert.size()) - static_cast<std::int64_t>(request.remove.size());

  probe_->begin_window(request.sample_steps);
  zone_force_->begin_window();
  if (!request.rim_moves.empty()) setup_.faces = request.rim_moves.front().faces;
  drive_->begin_window(request);
  exchange_->set(std::move(order), drive_);
  if (request.steps > 0) run(request.steps);
  check_none_lost();

  Advanced result;
  result.step = engine_->update->ntimestep;
  report_surfaces(result);
  report_segments(result, request.steps);
  report_energy_and_overlap(result);
  if (request.want_grains) gather_grains(result.grains);
  result.cpu = cpu_seconds() - cpu;
  MPI_Allreduce(MPI_IN_PLACE, &result.cpu, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return result;
}

void Session::check(const AdvanceRequest& request) const {
  const bool exchange = !request.insert.empty() || !request.remove.empty();
  if (request.steps < 0 || request.steps > std::numeric_limits<int>::max() || (request.steps == 0 && exchange)) {
    refuse(fmt::format("an advance over {} steps is not possible", request.steps));
  }
  if (request.rim_moves.size() > 1) refuse("the rim is to move twice in one advance");
  const std::vector<DriveFace>& faces = request.rim_moves.empty() ? setup_.faces : request.rim_moves.front().faces;
  if (!request.rim_moves.empty() && request.steps == 0) refuse("a rim cannot move in an advance over 0 steps");
  for (const RimMove& move : request.rim_moves)
    for (const Regrouped& g : move.driven)
      if (!has_segment(faces, g.face, g.segment))
        refuse(
            fmt::format("the grain {} is to be driven by segment {} of face {}, which does not exist", g.id, g.segment, g.face));
  if (request.sample_steps < 0) refuse(fmt::format("a mean over {} steps is not possible", request.sample_steps));
  for (const NewGrain& g : request.insert) {
    if (g.id <= 0 || g.id > std::numeric_limits<int>::max())
      refuse(fmt::format("a grain's id must be in 1..2147483647, not {}", g.id));
    if (!finite(g.position) || !finite(g.velocity) || !finite(g.spin))
      refuse(fmt::format("the new grain {} has no finite position, velocity or spin", g.id));
    if (!(g.radius > 0) || g.radius > setup_.max_radius) {
      refuse(
          fmt::format("the new grain {} has radius {:g} m; allowed are radii up to {:g} m", g.id, g.radius, setup_.max_radius));
    }
    for (int k = 0; k < 3; ++k) {
      if (!setup_.periodic[k] && (g.position[k] < setup_.lo[k] || g.position[k] > setup_.hi[k])) {
        refuse(fmt::format("the new grain {} at ({:g}, {:g}, {:g}) m lies outside of the box", g.id, g.position[0], g.position[1],
                           g.position[2]));
      }
    }
    if (g.segment >= 0 && !has_segment(faces, g.face, g.segment)) {
      refuse(fmt::format("the new grain {} is to be driven by segment {} of face {}, which does not exist", g.id, g.segment,
                         g.face));
    }
  }
  if (request.drives.empty() && request.rim_moves.empty()) return;
  bool fits = request.drives.size() == faces.size();
  for (std::size_t f = 0; fits && f < request.drives.size(); ++f) {
    fits = static_cast<int>(request.drives[f].size()) == faces[f].segments;
    for (const SegmentDrive& d : request.drives[f]) {
      if (!(d.least <= d.most) || !std::isfinite(d.push) || !std::isfinite(d.along) || !std::isfinite(d.slide) ||
          !finite(d.exit_velocity)) {
        refuse(fmt::format("face {} has a drive with velocities {:g}..{:g} m/s and push {:g} N, which is not possible", f,
                           d.least, d.most, d.push));
      }
    }
  }
  if (!fits) refuse("the drives given are not one for each segment of each face");
}

// Every id to be removed is there, once; no new id is there yet.
void Session::check_ids(const AdvanceRequest& request) const {
  std::unordered_map<int, std::size_t> place;  // of each id in `seen`
  const auto known = [](std::int64_t id) { return id > 0 && id <= std::numeric_limits<int>::max(); };
  for (const RimMove& move : request.rim_moves)
    for (const Regrouped& g : move.driven)
      if (!known(g.id) || !place.emplace(static_cast<int>(g.id), place.size()).second)
        refuse(fmt::format("the grain {} is to be driven, but is unknown or named twice", g.id));
  const std::size_t regrouped = place.size();
  for (const std::int64_t id : request.remove) {
    if (id <= 0 || id > std::numeric_limits<int>::max())
      refuse(fmt::format("the grain {} is to be removed, which is unknown", id));
    if (!place.emplace(static_cast<int>(id), place.size()).second) refuse(fmt::format("the grain {} is to be removed twice", id));
  }
  const std::size_t removals = place.size();
  for (const NewGrain& g : request.insert) {
    if (!place.emplace(static_cast<int>(g.id), place.size()).second) {
      refuse(fmt::format("the new grain {} is given twice, or also removed", g.id));
    }
  }
  if (place.empty()) return;
  std::vector<char> seen(place.size(), 0);
  const LAMMPS_NS::Atom& atom = *engine_->atom;
  for (int i = 0; i < atom.nlocal; ++i) {
    if (const auto it = place.find(atom.tag[i]); it != place.end()) seen[it->second] = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, seen.data(), static_cast<int>(seen.size()), MPI_CHAR, MPI_MAX, comm_);
  for (std::size_t k = 0; k < regrouped; ++k) {
    if (!seen[k]) refuse(fmt::format("the grain {} is to be driven, which is unknown", request.rim_moves.front().driven[k].id));
  }
  for (std::size_t k = regrouped; k < removals; ++k) {
    if (!seen[k]) refuse(fmt::format("the grain {} is to be removed, which is unknown", request.remove[k - regrouped]));
  }
  for (std::size_t k = removals; k < seen.size(); ++k) {
    if (seen[k])
      refuse(fmt::format("the new grain {} has the id of a grain that is there already", request.insert[k - removals].id));
  }
}

// The engine drops what leaves its box without a word.
void Session::check_none_lost() {
  const LAMMPS_NS::Atom& atom = *engine_->atom;
  std::int64_t inside = 0;
  bool broken = false;
  for (int i = 0; i < atom.nlocal; ++i) {
    bool in = true;
    for (int k = 0; k < 3; ++k) {
      broken = broken || !std::isfinite(atom.x[i][k]) || !std::isfinite(atom.v[i][k]);
      in = in && (setup_.periodic[k] || (atom.x[i][k] >= setup_.lo[k] && atom.x[i][k] <= setup_.hi[k]));
    }
    if (in) ++inside;
  }
  std::int64_t sums[2] = {inside, broken ? 1 : 0};
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_INT64_T, MPI_SUM, comm_);
  const std::int64_t step = engine_->update->ntimestep;
  if (sums[1]) run_away(fmt::format("by step {} the motion of a grain is no longer a finite number", step));
  if (sums[0] != grains_) {
    run_away(fmt::format("by step {} {} of {} grains have left the box ({:g}..{:g}, {:g}..{:g}, {:g}..{:g}) m", step,
                         grains_ - sums[0], grains_, setup_.lo[0], setup_.hi[0], setup_.lo[1], setup_.hi[1], setup_.lo[2],
                         setup_.hi[2]));
  }
}

}  // namespace couloir
