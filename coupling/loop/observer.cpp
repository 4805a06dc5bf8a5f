#include "coupling/loop/observer.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

double MassLedger::relative_error() const {
  const double scale = std::max(initial, entered);
  return scale > 0 ? std::abs(total() - initial) / scale : 0;
}

std::vector<double> WindowReport::samples_of(std::size_t obstacle, double interval) const {
  if (obstacle < force_samples.size() && !force_samples[obstacle].empty()) return force_samples[obstacle];
  if (interval <= 0 || obstacle >= obstacles.size()) return {};
  return std::vector<double>(std::size_t(length / interval + 1e-6), obstacles[obstacle].force[0]);
}

}  // namespace couloir
