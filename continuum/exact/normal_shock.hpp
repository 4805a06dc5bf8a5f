#pragma once
// A uniform flow (h1, u1) with Froude number Fr on a slope with delta = zeta, stopped by a wall: a shock runs back up the slope.
//
//   Fr^2 = (eta - 1)^2 (eta + 1) / (2 eta),  eta = h2 / h1;  shock speed -u1 / (eta - 1)
//   force on the wall per width and density: g' h1^2 eta^2 / 2

#include <cmath>

namespace couloir::exact {

// eta for a Froude number >= 0.
inline double normal_shock_depth_ratio(double froude) {
  double low = 1, high = 2 + 2 * froude;
  for (int k = 0; k < 200; ++k) {
    const double eta = 0.5 * (low + high);
    ((eta - 1) * (eta - 1) * (eta + 1) / (2 * eta) < froude * froude ? low : high) = eta;
  }
  return 0.5 * (low + high);
}

}  // namespace couloir::exact
