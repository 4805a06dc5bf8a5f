// A checkpoint is the engine's restart file and, beside it, PATH.drive: the rafts and which grains belong to them.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <numeric>
#include <sstream>
#include <thread>
#include <unordered_map>

#include "coupling/checkpoint/checkpoint_error.hpp"
#include "coupling/checkpoint/safe_file.hpp"
#include "coupling/workers/engine_errors.hpp"
#include "coupling/workers/liggghts_session.hpp"

namespace couloir {

namespace {

constexpr std::uint64_t magic = 0x32455649'52444c43;  // "CLDRIVE2"

template <class T>
void put(std::ostream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T get(std::istream& in) {
  T value{};
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

}  // namespace

// The engine does not look whether its writes succeed: on a full disk it would leave half a file without a word. So it writes
// into a pipe, and what comes out is ours to write.
std::vector<std::uint8_t> Session::restart_file() {
  if (rank_ != 0) {
    command("write_restart elsewhere");  // the first rank alone opens it
    return {};
  }
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw EngineFailure(fmt::format("no pipe for the checkpoint: {}", std::strerror(errno)), false);
  std::vector<std::uint8_t> bytes;
  std::thread reader([&] {
    std::array<std::uint8_t, 65536> some;
    for (ssize_t count; (count = read(ends[0], some.data(), some.size())) != 0;) {
      if (count > 0) bytes.insert(bytes.end(), some.begin(), some.begin() + count);
      if (count < 0 && errno != EINTR) break;
    }
  });
  const auto end_of_pipe = [&] {
    close(ends[1]);
    reader.join();
    close(ends[0]);
  };
  try {
    command(fmt::format("write_restart /proc/self/fd/{}", ends[1]));
  } catch (...) {
    end_of_pipe();
    throw;
  }
  end_of_pipe();
  return bytes;
}

// The writer sets itself up anew, as the reader will: from here on both have the same bits.
// The engine cannot write a restart file without grains: that file is then empty, and the reader starts anew at the same step.
void Session::checkpoint(const std::string& path) {
  std::vector<std::uint8_t> restart;
  if (grains_ > 0) restart = restart_file();
  const SideFile side = side_file();
  if (rank_ == 0) {
    try {
      const std::string beside = side.bytes();
      write_safely(path + ".drive", {reinterpret_cast<const std::uint8_t*>(beside.data()), beside.size()});
      write_safely(path, restart);
    } catch (const CheckpointError& error) {
      throw EngineFailure(error.what(), false);
    }
  }
  MPI_Barrier(comm_);
  command("run 0");
}

SideFile Session::side_file() const {
  SideFile side{engine_->update->ntimestep, grains_, drive_->rafts(), {}};
  std::vector<int> mine;
  for (int i = 0; i < engine_->atom->nlocal; ++i) {
    if (const int raft = drive_->of_grain(i); raft != FixDrive::free_grain)
      mine.insert(mine.end(), {engine_->atom->tag[i], raft});
  }
  std::vector<int> counts(static_cast<std::size_t>(ranks_)), offsets(static_cast<std::size_t>(ranks_));
  const int count = static_cast<int>(mine.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  side.driven.resize(static_cast<std::size_t>(offsets.back() + counts.back()));
  MPI_Allgatherv(mine.data(), count, MPI_INT, side.driven.data(), counts.data(), offsets.data(), MPI_INT, comm_);
  return side;
}

void Session::take(const SideFile& side) {
  grains_ = side.grains;
  for (std::size_t r = 0; r < side.rafts.size(); ++r) {
    drive_->rafts()[r].drive = side.rafts[r].drive;
    drive_->rafts()[r].velocity = side.rafts[r].velocity;
    drive_->rafts()[r].mass = side.rafts[r].mass;
  }
  std::unordered_map<int, int> raft_of;
  for (std::size_t k = 0; k + 1 < side.driven.size(); k += 2) raft_of[side.driven[k]] = side.driven[k + 1];
  for (int i = 0; i < engine_->atom->nlocal; ++i) {
    if (const auto it = raft_of.find(engine_->atom->tag[i]); it != raft_of.end()) drive_->of_grain(i) = it->second;
  }
  drive_->just_created = 0;  // else the engine's set-up would make all grains free
  drive_->note_exits();
}

std::string SideFile::bytes() const {
  std::ostringstream out;
  put(out, magic);
  put(out, step);
  put(out, grains);
  put(out, static_cast<std::uint64_t>(rafts.size()));
  for (const FixDrive::Raft& raft : rafts) {
    const SegmentDrive& d = raft.drive;
    for (const double value : {raft.velocity, raft.mass, d.push, d.most, d.least, d.along, d.least_mass, d.slide,
                               d.exit_active ? 1.0 : 0.0, d.exit_velocity[0], d.exit_velocity[1], d.exit_velocity[2]}) {
      put(out, value);
    }
  }
  put(out, static_cast<std::uint64_t>(driven.size()));
  out.write(reinterpret_cast<const char*>(driven.data()), static_cast<std::streamsize>(driven.size() * sizeof(int)));
  return out.str();
}

SideFile SideFile::read(const std::string& path, const std::vector<DriveFace>& faces) {
  SideFile side;
  std::ifstream in(path, std::ios::binary);
  const bool ours = get<std::uint64_t>(in) == magic;
  side.step = get<std::int64_t>(in);
  side.grains = get<std::int64_t>(in);
  const auto rafts = get<std::uint64_t>(in);
  std::uint64_t expected = 0;
  for (const DriveFace& face : faces) expected += static_cast<std::uint64_t>(face.segments);
  if (!in || !ours || rafts != expected)
    throw EngineFailure(fmt::format("{} is missing or does not belong to this scene's zone", path), true);
  side.rafts.resize(rafts);
  for (FixDrive::Raft& raft : side.rafts) {
    SegmentDrive& d = raft.drive;
    for (double* value : {&raft.velocity, &raft.mass, &d.push, &d.most, &d.least, &d.along, &d.least_mass, &d.slide})
      *value = get<double>(in);
    d.exit_active = get<double>(in) != 0;
    for (double& value : d.exit_velocity) value = get<double>(in);
  }
  const auto count = get<std::uint64_t>(in);
  if (in && count <= 2 * static_cast<std::uint64_t>(side.grains)) side.driven.resize(count);
  in.read(reinterpret_cast<char*>(side.driven.data()), static_cast<std::streamsize>(side.driven.size() * sizeof(int)));
  if (!in || side.driven.size() != count) throw EngineFailure(path + " is cut short", true);
  return side;
}

}  // namespace couloir
