#pragma once
// The largest momentum met so far, by which a window's residual is judged.

#include <algorithm>
#include <cmath>

#include "coupling/loop/observer.hpp"

namespace couloir {

class MomentumBook {
 public:
  // present: the run's momentum now [N s]; at_least: a floor for runs at rest. Fills in residual and scale.
  void close(MomentumLedger& m, double present) {
    largest_ = std::max(largest_, std::abs(present));
    m.residual = m.storage - m.gravity - m.bed - m.obstacles - m.boundary - m.faces;
    m.scale = largest_;
  }

 private:
  double largest_ = 0;
};

}  // namespace couloir
