#pragma once
// The spreading parabolic cap in 1D (Savage and Hutter 1989), in its own frame that slides with the slab's acceleration:
//
//   h = H (1 - xi^2 / (L G)^2) / G,  u = u_c + xi G'/G
//   in scales L (half length), H (height), T = L / sqrt(K g' H):  G'' = 2 / G^2, G(0) = 1, G'(0) = 0,
//   t = [sqrt(G (G - 1)) + ln(sqrt(G) + sqrt(G - 1))] / 2,  G' = 2 sqrt(1 - 1/G)
//
// (with B = 1). Valid while the cap spreads, K active, and all of it moves down: from rest that needs
// 2 K H / L <= tan(zeta) - tan(delta). No wave from a front has reached |xi| < L sqrt(G): it runs inward by
// d(acos(xi / (L G))) / dt = 1 / (T G^1.5), that is acos(xi / (L G)) = atan(sqrt(G - 1)).

#include <cmath>

namespace couloir::exact {

struct ParabolicCap {
  double length, height, weight;  // L, H [m], K g cos(zeta) [m/s2]

  double time_scale() const { return length / std::sqrt(weight * height); }
  // G at time t [s].
  double growth(double t) const {
    const double target = t / time_scale();
    double low = 1, high = 2 + 2 * target;
    for (int k = 0; k < 200; ++k) {
      const double g = 0.5 * (low + high);
      const double when = 0.5 * (std::sqrt(g * (g - 1)) + std::log(std::sqrt(g) + std::sqrt(g - 1)));
      (when < target ? low : high) = g;
    }
    return 0.5 * (low + high);
  }
  // xi: distance from the centre [m].
  double depth(double xi, double g) const {
    const double s = xi / (length * g);
    return s * s < 1 ? height * (1 - s * s) / g : 0.0;
  }
  double spreading(double xi, double g) const { return xi / g * 2 * std::sqrt(1 - 1 / g) / time_scale(); }
};

}  // namespace couloir::exact
