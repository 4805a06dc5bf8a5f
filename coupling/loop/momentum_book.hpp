#pragma once
// The largest momentum, or exchange of it in a window, met so far: by it a window's residual is judged, at rest as well.

#include <algorithm>
#include <cmath>

#include "coupling/loop/observer.hpp"

namespace couloir {

class MomentumBook {
 public:
  // present: the run's momentum now [N s]; of_its_parts: what its parts have without regard to direction, where a symmetric flow
  // has none as a whole. Fills in residual and scale.
  void close(MomentumLedger& m, double present, double of_its_parts = 0) {
    const double exchanged = std::abs(m.gravity) + std::abs(m.bed) + std::abs(m.obstacles) + std::abs(m.boundary) +
                             std::abs(m.faces) + std::abs(m.copied);
    largest_ = std::max({largest_, std::abs(present), of_its_parts, exchanged});
    m.residual = m.storage - m.gravity - m.bed - m.obstacles - m.boundary - m.faces - m.copied;
    m.scale = largest_;
  }

 private:
  double largest_ = 0;
};

}  // namespace couloir
