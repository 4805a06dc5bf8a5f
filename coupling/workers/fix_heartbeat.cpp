#include "coupling/workers/fix_heartbeat.hpp"

namespace couloir {

FixHeartbeat::FixHeartbeat(LAMMPS_NS::LAMMPS* lmp, int n, char** words) : Fix(lmp, n, words) {
  nevery = 1;
}

int FixHeartbeat::setmask() {
  return LAMMPS_NS::FixConst::END_OF_STEP;
}

void FixHeartbeat::end_of_step() {
  const auto now = std::chrono::steady_clock::now();
  if (!beat || now - last_ < std::chrono::milliseconds(500)) return;
  last_ = now;
  beat();
}

}  // namespace couloir
