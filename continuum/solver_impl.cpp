#include "continuum/solver_impl.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "continuum/errors.hpp"
#include "continuum/scheme/effects.hpp"

namespace couloir {
namespace {

constexpr int most_halvings = 30;  // of a step that would overdraw a cell; a short enough step never does

void check(const SolverSettings& s, const ReferenceSurface& surface) {
  const auto require = [](bool good, const char* sentence) {
    if (!good) throw std::invalid_argument(sentence);
  };
  require(s.gravity > 0, "The gravity must be positive; correct the scene.");
  require(s.cfl > 0 && s.cfl <= 0.5,
          "The CFL number must be above 0 and at most 0.5, where the depth stays positive; lower continuum.cfl.");
  require(s.limiter != Limiter::eno, "The central-upwind scheme has no ENO slopes; use another limiter, or the scheme noc.");
  require(s.dry_depth > 0, "The dry depth must be positive; correct the settings.");
  require(s.threads >= 1, "The continuum needs at least one thread; correct the number of threads.");
  require(s.closure.tan_delta >= 0, "The basal friction must not be negative; correct the material.");
  require(!(surface.curved() && s.sides[0].kind == Side::Kind::periodic),
          "A surface with an arc cannot be periodic along the slope; choose other sides upstream and downstream.");
}

Parameters parameters_of(const SolverSettings& s) {
  return {s.closure, s.limiter, s.sides, s.dry_depth, {}};
}

}  // namespace

Solver::Impl::Impl(const SolverSettings& s, const ReferenceSurface& surface, const StepBed& bed)
    : settings((check(s, surface), s)),
      parameters(parameters_of(s)),
      mesh(s.grid, s.block, surface, bed, s.gravity, s.closure.curvature),
      ghosts(mesh, s.sides),
      states(mesh.blocks().size()),
      faces(mesh.blocks().size()),
      scratch(s.threads),
      inflow_block(mesh.blocks().size(), 0),
      impulse(bed.obstacles.size()) {
  ghosts.extend(mesh);
  steepest = mesh.steepest();
  for (StageRecord& r : record) r.tallies.resize(states.size());
  int largest = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Block& b = mesh.blocks()[k];
    states[k].now.resize(b.size());
    states[k].start.resize(b.size());
    if (with_earth_pressure(parameters)) {
      states[k].passive_x.assign(b.size(), 0.0);
      states[k].passive_y.assign(b.size(), 0.0);
    }
    states[k].open.assign(b.size(), 1.0);
    faces[k].steps = StepFaces(b);
    faces[k].pushed = PushedCells(b);
    largest = std::max(largest, b.size());
    const auto comes_in = [&](const Side& side) {
      return side.kind == Side::Kind::inflow && fastest_inflow(side, s.gravity, 0) > 0;
    };
    const bool at_side[] = {b.i0 == 0, b.i0 + b.nx == s.grid.nx, b.j0 == 0, b.j0 + b.ny == s.grid.ny};
    for (int side = 0; side < 4; ++side) {
      if (at_side[side] && comes_in(s.sides[side])) inflow_block[k] = 1;
    }
  }
  for (Scratch& w : scratch) w.resize(largest);
}

void Solver::Impl::step(double dt) {
  if (!(dt > 0)) throw std::invalid_argument("A step of the continuum needs a positive length in time.");
  dt = std::min(dt, stable_dt());
  const double row = next_row(settings.sides, time);
  double end = row - time <= dt ? row : time + dt;
  dt = std::min(dt, row - time);
  for (int halvings = 0;; ++halvings) {
    zone.limit(dt, std::ldexp(0.5, -halvings), [&](int i, int j) { return get(i, j).h; });
    choose_blocks(false);
    for (int side = 0; side < 4; ++side) parameters.discharge[side] = mean_discharge(settings.sides[side], time, end);
    run(StageName::predictor, dt);
    choose_blocks(true);
    fill_ghosts(end, Moment::before);
    run(StageName::corrector, dt);
    if (!negative()) break;
    if (halvings == most_halvings) fail_negative(dt);
    go_back();
    dt *= 0.5;
    end = time + dt;
  }
  collect_tallies();
  count_zone(dt);
  time = end;
  strained = dt;
  ++steps;
  rate.reset();
}

// Positivity asks for rate * dt <= cfl <= 1/2. Slope and bed may speed up what is slow now: their part grows with dt.
double Solver::Impl::stable_dt() {
  refresh();
  const double r = *rate;
  if (!(r > 0) && steepest == 0) return std::numeric_limits<double>::max();
  return 2 * settings.cfl / (r + std::sqrt(r * r + 4 * steepest * settings.cfl));
}

void Solver::Impl::refresh() {
  if (rate) return;
  choose_blocks(false);
  fill_ghosts(time);
  std::vector<double> rates(states.size(), 0.0);
  const int n = static_cast<int>(chosen.size());
#pragma omp parallel for num_threads(settings.threads) schedule(dynamic)
  for (int k = 0; k < n; ++k) {
    const int b = chosen[k];
    rates[b] = kernels.begin_step(parameters, mesh.blocks()[b], faces[b], states[b], scratch[omp_get_thread_num()], strained);
  }
  strained = 0;
  if (with_earth_pressure(parameters)) {
#pragma omp parallel for num_threads(settings.threads) schedule(static)
    for (int k = 0; k < n; ++k) ghosts.fill_passive(states, chosen[k]);
  }
  if (std::ranges::any_of(rates, [](double r) { return std::isinf(r); })) check_finite();
  rate = *std::max_element(rates.begin(), rates.end());
}

void Solver::Impl::choose_blocks(bool corrector) {
  const int bx = mesh.blocks_x(), by = mesh.blocks_y();
  const bool wraps_x = settings.sides[0].kind == Side::Kind::periodic, wraps_y = settings.sides[2].kind == Side::Kind::periodic;
  const auto near_wet = [&](int bi, int bj) {
    for (int dj : {-1, 0, 1}) {
      for (int di : {-1, 0, 1}) {
        const int i = wraps_x ? (bi + di + bx) % bx : bi + di, j = wraps_y ? (bj + dj + by) % by : bj + dj;
        if (i >= 0 && j >= 0 && i < bx && j < by && states[j * bx + i].wet) return true;
      }
    }
    return false;
  };
  chosen.clear();
  for (int k = 0; k < bx * by; ++k) {
    const bool active = inflow_block[k] || !faces[k].rim.empty() || near_wet(k % bx, k / bx);
    if (!corrector) {
      states[k].stepped = active;
      states[k].was_wet = states[k].wet;
    } else if (active && !states[k].stepped) {
      states[k].start = states[k].now;  // the predictor left it as it was
    }
    if (active || (corrector && states[k].stepped)) chosen.push_back(k);
  }
}

void Solver::Impl::fill_ghosts(double at, Moment moment) {
  ghosts.set_time(at, moment);
  for (int side = 0; side < 4; ++side) {
    parameters.inflow[side] = inflow_at(settings.sides[side], at, moment);
  }
  const int n = static_cast<int>(chosen.size());
#pragma omp parallel for num_threads(settings.threads) schedule(static)
  for (int k = 0; k < n; ++k) {
    ghosts.fill(states, chosen[k]);
    if (with_earth_pressure(parameters)) ghosts.fill_passive(states, chosen[k]);
  }
}

void Solver::Impl::run(StageName stage, double dt) {
  const int n = static_cast<int>(chosen.size());
  StageRecord& r = record[stage == StageName::predictor ? 0 : 1];
  r.blocks = chosen;
  std::vector<Tally>& tally = r.tallies;
#pragma omp parallel for num_threads(settings.threads) schedule(dynamic)
  for (int k = 0; k < n; ++k) {
    const int b = chosen[k];
    tally[b].reset(impulse.size(), gauges.size(), boxes.size());
    kernels.run_stage(parameters, mesh.blocks()[b], faces[b], zone, states[b], scratch[omp_get_thread_num()], stage, dt, tally[b]);
  }
}

// The bound of stable_dt() is that of the step's start; a stage that speeds the flow up a lot may overdraw a cell.
bool Solver::Impl::negative() const {
  for (const StageRecord& r : record) {
    for (int k : r.blocks) {
      if (r.tallies[k].min_depth < 0) return true;
    }
  }
  return false;
}

void Solver::Impl::go_back() {
  for (int k : record[1].blocks) {  // the corrector's blocks hold the predictor's
    BlockState& s = states[k];
    const Block& b = mesh.blocks()[k];
    for (int j = 0; j < b.ny; ++j) {
      for (int c = b.at(0, j); c < b.at(b.nx, j); ++c) {
        s.now.h[c] = s.start.h[c], s.now.hu[c] = s.start.hu[c], s.now.hv[c] = s.start.hv[c];
      }
    }
    s.wet = s.was_wet;
  }
  choose_blocks(false);
  fill_ghosts(time);
}

void Solver::Impl::collect_tallies() {
  bool finite = true;
  for (const StageRecord& r : record) {
    for (int k : r.blocks) {
      const Tally& t = r.tallies[k];
      const Block& b = mesh.blocks()[k];
      budget.add(t.budget);
      for (std::size_t o = 0; o < impulse.size(); ++o) {
        impulse[o][0] += t.impulse[o][0];
        impulse[o][1] += t.impulse[o][1];
      }
      for (std::size_t g = 0; g < gauges.size(); ++g) gauges[g].volume += t.gauge[g];
      for (std::size_t n = 0; n < boxes.size(); ++n) boxes[n].terms.add(t.boxes[n]);
      min_depth = min_depth_met ? std::min(min_depth, t.min_depth) : t.min_depth;
      min_depth_met = true;
      cell_updates += static_cast<std::int64_t>(b.nx) * b.ny;
      finite = finite && t.finite;
    }
  }
  if (!finite) check_finite();
}

void Solver::Impl::count_zone(double dt) {
  zone.count(dt);
  for (SideName side : {SideName::upstream, SideName::downstream, SideName::left, SideName::right}) {
    if (!zone.has_rim(side)) continue;
    const bool low = side == SideName::upstream || side == SideName::left;
    const bool across_x = side == SideName::upstream || side == SideName::downstream;
    const double inward = (low ? -dt : dt) * (across_x ? settings.grid.dy : settings.grid.dx);
    for (int k = 0; k < zone.faces(side); ++k) {
      const FaceFlux& f = zone.actual(side, k);
      budget.mass_zone += inward * f.mass;
      budget.zone[0] += inward * f.mom_x;
      budget.zone[1] += inward * f.mom_y;
    }
  }
}

void Solver::Impl::check_finite() const {
  for (int j = 0; j < settings.grid.ny; ++j) {
    for (int i = 0; i < settings.grid.nx; ++i) {
      const FlowState q = get(i, j);
      if (std::isfinite(q.h) && std::isfinite(q.hu) && std::isfinite(q.hv)) continue;
      std::ostringstream text;
      text << "The flow is not finite in cell (" << i << ", " << j << ") at x = " << settings.grid.x(i)
           << " m, y = " << settings.grid.y(j) << " m at t = " << time << " s (step " << steps << "): h = " << q.h
           << " m, hu = " << q.hu << " m2/s, hv = " << q.hv
           << " m2/s; check what was released or handed in there, or lower continuum.cfl.";
      throw NumericsError(text.str());
    }
  }
}

void Solver::Impl::fail_negative(double dt) const {
  int block = 0;
  double least = 0;
  for (const StageRecord& r : record) {
    for (int k : r.blocks) {
      if (r.tallies[k].min_depth < least) least = r.tallies[k].min_depth, block = k;
    }
  }
  const Block& b = mesh.blocks()[block];
  std::ostringstream text;
  text << "More material would leave a cell than it holds (depth " << least << " m) between x = " << settings.grid.x(b.i0)
       << " m and " << settings.grid.x(b.i0 + b.nx - 1) << " m, y = " << settings.grid.y(b.j0) << " m and "
       << settings.grid.y(b.j0 + b.ny - 1) << " m at t = " << time << " s (step " << steps << "), even with a step of " << dt
       << " s; check what is handed in there, or lower continuum.cfl.";
  throw NumericsError(text.str());
}

void Solver::Impl::fail_step(double dt) const {
  const Grid& g = settings.grid;
  int i = 0, j = 0;
  double fastest = -1;
  for (int n = 0; n < g.ny; ++n) {
    for (int m = 0; m < g.nx; ++m) {
      const FlowState q = get(m, n);
      const double speed = q.h >= settings.dry_depth ? std::hypot(q.hu, q.hv) / q.h + std::sqrt(settings.gravity * q.h) : 0.0;
      if (speed > fastest) fastest = speed, i = m, j = n;
    }
  }
  std::ostringstream text;
  text << "The flow has become so fast that its stable step of " << dt << " s would never end the run, at t = " << time
       << " s (step " << steps << "): " << fastest << " m/s with its waves in cell (" << i << ", " << j << ") at x = " << g.x(i)
       << " m, y = " << g.y(j) << " m; check what was released or handed in there, or use larger cells.";
  throw NumericsError(text.str());
}

void Solver::Impl::cover(const CellBox& box) {
  zone = CoveredZone(box, settings.grid);
  mark_open();
  lay_rim();
  rate.reset();
}

void Solver::Impl::uncover() {
  zone = CoveredZone();
  mark_open();
  lay_rim();
  rate.reset();
}

void Solver::Impl::mark_open() {
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Block& b = mesh.blocks()[k];
    for (int j = 0; j < b.ny; ++j) {
      for (int i = 0; i < b.nx; ++i) states[k].open[b.at(i, j)] = zone.box().contains(b.i0 + i, b.j0 + j) ? 0.0 : 1.0;
    }
  }
  for (std::size_t k = 0; k < states.size(); ++k) ghosts.fill_open(states, static_cast<int>(k));
}

// Every block meets the rim faces between its own cells and their neighbours, also where the outer cell is another block's.
void Solver::Impl::lay_rim() {
  for (BlockFaces& f : faces) f.rim.clear();
  const CellBox& box = zone.box();
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Block& b = mesh.blocks()[n];
    const auto add = [&](SideName side, bool along_x, int gi, int gj, int k) {
      const int i = gi - b.i0, j = gj - b.j0;
      const bool met = i >= 0 && j >= 0 && i < b.nx + (along_x ? 1 : 0) && j < b.ny + (along_x ? 0 : 1);
      if (met && zone.has_rim(side)) faces[n].rim.push_back({b.at(i, j), along_x, side, k});
    };
    for (int k = 0; k < box.j1 - box.j0; ++k) {
      add(SideName::upstream, true, box.i0, box.j0 + k, k);
      add(SideName::downstream, true, box.i1, box.j0 + k, k);
    }
    for (int k = 0; k < box.i1 - box.i0; ++k) {
      add(SideName::left, false, box.i0 + k, box.j0, k);
      add(SideName::right, false, box.i0 + k, box.j1, k);
    }
  }
}

// Each face belongs to the block of the cell above it, the last one to the last block.
void Solver::Impl::lay_gauge(int id) {
  const Gauge& g = gauges[id];
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Block& b = mesh.blocks()[n];
    const bool last = b.i0 + b.nx == settings.grid.nx;
    const int i = g.i - b.i0, j0 = std::max(g.j0 - b.j0, 0), j1 = std::min(g.j1 - b.j0, b.ny);
    if (i >= 0 && i < b.nx + (last ? 1 : 0) && j0 < j1) faces[n].gauges.push_back({id, i, j0, j1});
  }
}

void Solver::Impl::lay_box(int id) {
  const CellBox& box = boxes[id].cells;
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Block& b = mesh.blocks()[n];
    const int i0 = std::max(box.i0 - b.i0, 0), i1 = std::min(box.i1 - b.i0, b.nx);
    const int j0 = std::max(box.j0 - b.j0, 0), j1 = std::min(box.j1 - b.j0, b.ny);
    if (i0 >= i1 || j0 >= j1) continue;
    faces[n].boxes.push_back(
        {id, i0, i1, j0, j1, {b.i0 + i0 == box.i0, b.i0 + i1 == box.i1, b.j0 + j0 == box.j0, b.j0 + j1 == box.j1}});
  }
}

std::array<double, 2> Solver::Impl::momentum_in(const CellBox& box) const {
  std::array<double, 2> sum{};
  for (int j = box.j0; j < box.j1; ++j) {
    for (int i = box.i0; i < box.i1; ++i) {
      const FlowState q = get(i, j);
      sum[0] += q.hu, sum[1] += q.hv;
    }
  }
  const double area = settings.grid.dx * settings.grid.dy;
  return {sum[0] * area, sum[1] * area};
}

void Solver::Impl::put(int i, int j, const FlowState& q) {
  const CellPlace place = mesh.place(i, j);
  BlockState& s = states[place.block];
  s.now.h[place.cell] = q.h;
  s.now.hu[place.cell] = q.h >= settings.dry_depth || std::isnan(q.h) ? q.hu : 0.0;
  s.now.hv[place.cell] = q.h >= settings.dry_depth || std::isnan(q.h) ? q.hv : 0.0;
  s.wet = s.wet || !(q.h < settings.dry_depth);
  rate.reset();
}

FlowState Solver::Impl::get(int i, int j) const {
  const CellPlace place = mesh.place(i, j);
  const Fields& q = states[place.block].now;
  return {q.h[place.cell], q.hu[place.cell], q.hv[place.cell]};
}

void Solver::Impl::put_passive(int i, int j, const std::array<double, 2>& share) {
  if (!with_earth_pressure(parameters)) return;
  const CellPlace place = mesh.place(i, j);
  states[place.block].passive_x[place.cell] = share[0];
  states[place.block].passive_y[place.cell] = share[1];
  rate.reset();
}

std::array<double, 2> Solver::Impl::passive(int i, int j) const {
  if (!with_earth_pressure(parameters)) return {};
  const CellPlace place = mesh.place(i, j);
  return {states[place.block].passive_x[place.cell], states[place.block].passive_y[place.cell]};
}
}  // namespace couloir
