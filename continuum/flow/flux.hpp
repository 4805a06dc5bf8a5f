#pragma once
// The physical fluxes (2.88), pointwise. weight = K g cos(zeta) [m/s2], the effective weight in the pressure.

#include "continuum/flow/flow_state.hpp"

namespace couloir {

// Depth-integrated pressure per density K g cos(zeta) h^2 / 2 [m3/s2].
inline double pressure(double h, double weight) {
  return 0.5 * weight * h * h;
}

// Flux along x of depth h and velocity (u, v).
inline FaceFlux flux_x(double h, double u, double v, double weight) {
  return {h * u, h * u * u + pressure(h, weight), h * u * v};
}

// Flux along y.
inline FaceFlux flux_y(double h, double u, double v, double weight) {
  return {h * v, h * u * v, h * v * v + pressure(h, weight)};
}

}  // namespace couloir
