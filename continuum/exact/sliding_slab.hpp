#pragma once
// A uniform layer on an incline: u = u0 + g (sin(zeta) - cos(zeta) tan(delta)) t, until it stops.

#include <algorithm>
#include <cmath>

namespace couloir::exact {

inline double sliding_slab_velocity(double t, double u0, double gravity, double zeta, double tan_delta) {
  return std::max(0.0, u0 + gravity * (std::sin(zeta) - std::cos(zeta) * tan_delta) * t);
}

}  // namespace couloir::exact
