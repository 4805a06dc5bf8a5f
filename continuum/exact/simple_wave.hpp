#pragma once
// A simple wave that runs down an incline with Coulomb friction, K = 1, smooth until it breaks. In the frame that slides with the
// slab (velocity m t, m = g' (tan(zeta) - tan(delta))) the equations are those of a flat bed without friction as long as the flow
// moves down:
//
//   w - 2 c = w0 - 2 c0 everywhere,  c = c0 + a sin(k xi0),  xi = xi0 + (w + c) t,  x = xi + m t^2 / 2,  u = w + m t
//
// (Stoker 1957, section 10.2). Valid for t < 1 / (3 a k).

#include <cmath>

#include "continuum/exact/depth_velocity.hpp"

namespace couloir::exact {

struct SimpleWave {
  double depth, speed;           // undisturbed h0 [m], w0 [m/s]
  double amplitude, wavenumber;  // a [m/s] of the wave speed, k [1/m]
  double weight;                 // g' [m/s2]
  double drive = 0;              // m [m/s2]

  double breaks() const { return 1 / (3 * amplitude * wavenumber); }  // [s]

  DepthVelocity at(double x, double t) const {
    const double c0 = std::sqrt(weight * depth), xi = x - 0.5 * drive * t * t;
    // Newton for xi0 on a function whose slope lies within 1 +- t / breaks().
    double from = xi - (speed + c0) * t;
    for (int n = 0; n < 60; ++n) {
      const double rise = amplitude * std::sin(wavenumber * from);
      const double miss = from + (speed + c0 + 3 * rise) * t - xi;
      from -= miss / (1 + 3 * amplitude * wavenumber * std::cos(wavenumber * from) * t);
    }
    const double rise = amplitude * std::sin(wavenumber * from), c = c0 + rise;
    return {c * c / weight, speed + 2 * rise + drive * t};
  }
};

}  // namespace couloir::exact
