#pragma once
// Coulomb basal friction with the curvature term (2.91), (2.92): it may stop the flow but never turn it round.

#include <algorithm>

namespace couloir {

// The momentum that friction can take in dt: dt tan(delta) (g cos(zeta) + kappa u^2) h [m2/s]; none where a flow over a brink
// (kappa < 0) is so fast that nothing presses it onto its bed.
inline double coulomb_capacity(double dt, double tan_delta, double weight, double kappa, double u, double h) {
  return dt * tan_delta * std::max(0.0, weight + kappa * u * u) * h;
}

// What friction leaves of a momentum of this magnitude, as a factor in [0, 1]. What exceeds it by round-off alone is stopped,
// too.
inline double coulomb_factor(double magnitude, double capacity) {
  const double left = 1.0 - capacity / std::max(magnitude, 1e-300);
  return left > 1e-12 ? left : 0.0;
}

}  // namespace couloir
