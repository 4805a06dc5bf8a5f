#pragma once
// Approximate Riemann solutions at a face, pointwise. g = K g cos(zeta) is the weight in the pressure of each side.

#include <algorithm>
#include <cmath>

#include "continuum/flow/flux.hpp"

namespace couloir {

struct NormalFlux {
  double mass, momentum;  // [m2/s], [m3/s2]
};

// Harten-Lax-van Leer with the exact front speeds u -+ 2c where one side is dry.
// Written so that exchanging the sides and turning the velocities gives the same bits.
// shock: the faster of the two speeds both ways (Rusanov), which leaves no ripples behind a shock that moves slowly.
inline NormalFlux hll(double hl, double ul, double gl, double hr, double ur, double gr, bool shock = false) {
  const double cl = std::sqrt(gl * hl), cr = std::sqrt(gr * hr);
  double sl = std::min(ul - cl, ur - cr), sr = std::max(ul + cl, ur + cr);
  sl = hr > 0 ? sl : ul - cl;
  sr = hr > 0 ? sr : ul + 2 * cl;
  sl = hl > 0 ? sl : ur - 2 * cr;
  sr = hl > 0 ? sr : ur + cr;
  const double fastest = std::max(std::abs(sl), std::abs(sr));
  sl = shock ? -fastest : std::min(sl, 0.0);
  sr = shock ? fastest : std::max(sr, 0.0);
  const double width = sr - sl;
  const double per_width = width > 0 ? 1 / width : 0.0;
  const double ql = hl * ul, qr = hr * ur;
  const double ml = ql * ul + pressure(hl, gl), mr = qr * ur + pressure(hr, gr);
  return {((sr * ql - sl * qr) + sl * sr * (hr - hl)) * per_width, ((sr * ml - sl * mr) + sl * sr * (qr - ql)) * per_width};
}

// Momentum flux into a wall: the HLL flux against the mirrored state, h u^2 + g h^2/2 + (|u| + c) h u; u > 0 towards the wall.
// A wall does not pull: never negative. Not decreasing in h.
inline double wall_flux(double h, double u, double g) {
  const double c = std::sqrt(g * h);
  return std::max(0.0, h * u * u + pressure(h, g) + (std::abs(u) + c) * h * u);
}

}  // namespace couloir
