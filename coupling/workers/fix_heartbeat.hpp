#pragma once
// Calls back every half second or so during a run: a sign of life.

#include <chrono>
#include <functional>

#include "coupling/workers/engine_headers.hpp"

namespace couloir {

class FixHeartbeat : public LAMMPS_NS::Fix {
 public:
  FixHeartbeat(LAMMPS_NS::LAMMPS*, int, char**);
  int setmask() override;
  void end_of_step() override;

  std::function<void()> beat;

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace couloir
