#pragma once
// The one run of the engine in this process (a second instance would upset the first), on all ranks: each rank holds a Session
// and calls its functions with the same arguments.
// All throw EngineFailure.

#include <functional>
#include <string>

#include "coupling/engine/grain_engine.hpp"
#include "coupling/workers/fix_drive.hpp"
#include "coupling/workers/fix_exchange.hpp"
#include "coupling/workers/fix_force_probe.hpp"
#include "coupling/workers/fix_zone_force.hpp"

namespace couloir {

// What the engine's own restart file does not hold.
struct SideFile {
  std::int64_t step = 0, grains = 0;
  std::vector<FixDrive::Raft> rafts;
  std::vector<int> driven;  // pairs of grain and raft

  std::string bytes() const;
  static SideFile read(const std::string& path, const std::vector<DriveFace>&);  // whose rafts they must be
};

class Session {
 public:
  // Starts anew, or goes on from a checkpoint. `beat` is called now and then during an advance.
  Session(const EngineSetup&, const std::string& checkpoint, MPI_Comm, std::function<void()> beat);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  std::string engine_name() const;          // "LIGGGHTS 3.8.0"
  Advanced advance(const AdvanceRequest&);  // complete on rank 0 only
  void checkpoint(const std::string& path);

 private:
  void command(const std::string&);
  void run(std::int64_t steps);
  void check(const AdvanceRequest&) const;
  void check_ids(const AdvanceRequest&) const;
  void check_none_lost();
  void report_surfaces(Advanced&) const;
  void report_segments(Advanced&, std::int64_t steps) const;
  void report_energy_and_overlap(Advanced&) const;
  void gather_grains(Grains&) const;
  std::vector<std::uint8_t> restart_file();  // on the first rank
  SideFile side_file() const;                // the same on every rank
  void take(const SideFile&);

  EngineSetup setup_;
  MPI_Comm comm_;
  int rank_ = 0, ranks_ = 1;
  LAMMPS_NS::LAMMPS* engine_ = nullptr;
  FixExchange* exchange_ = nullptr;
  FixDrive* drive_ = nullptr;
  FixForceProbe* probe_ = nullptr;
  FixZoneForce* zone_force_ = nullptr;
  std::int64_t grains_ = 0;  // that there should be
};

}  // namespace couloir
