#pragma once
// A steady layer that runs down a chute (incline, arc, run-out) with Coulomb friction and the curvature term, h u = q, faster
// than its waves. The momentum equation (2.91) in conservative form, with G(x) = K g cos(zeta) and kappa = -d zeta/dx:
//
//   d_x(q u + G h^2/2) = h S,   S = g sin(zeta) - tan(delta) (g cos(zeta) + kappa u^2)
//   h = q/u:  q u' - G h^2 u'/u + G' h^2/2 = h S   =>   u u' = (S - G' h/2) / (1 - G h / u^2),   G' = K g sin(zeta) kappa
//
// integrated from the inflow by Runge-Kutta of order 4, and separately over incline, arc and run-out, since kappa jumps between
// them. As h goes to 0 what is left is linear in w = u^2 over the arc:
//
//   dw/dzeta = 2 mu w - (2 g/kappa) (sin(zeta) - mu cos(zeta)),  solved by   w = P sin(zeta) + Q cos(zeta) + C exp(2 mu zeta),
//   P = 6 g mu / (kappa (1 + 4 mu^2)),  Q = (2 g/kappa) (1 - 2 mu^2) / (1 + 4 mu^2)
//
// so that without weight an arc of angle zeta leaves the share exp(-mu zeta) of the velocity.

#include <algorithm>
#include <cmath>

#include "continuum/exact/depth_velocity.hpp"

namespace couloir::exact {

struct SteadyChute {
  double angle, slope, arc;   // zeta0 [rad], lengths [m] as in ReferenceSurface::chute
  double gravity, mu, k;      // [m/s2], tan(delta), earth pressure coefficient
  double inflow_h, inflow_u;  // at x = 0 [m], [m/s]; u^2 > K g cos(zeta) h all the way down
  bool curvature = true;      // whether kappa u^2 is in the friction

  // At x >= 0 [m].
  DepthVelocity at(double x) const {
    double u = inflow_u;
    u = part(
        u, 0, std::min(x, slope), [&](double) { return angle; }, 0);
    if (x > slope)
      u = part(
          u, slope, std::min(x, slope + arc), [&](double s) { return angle * (1 - (s - slope) / arc); }, angle / arc);
    if (x > slope + arc)
      u = part(
          u, slope + arc, x, [](double) { return 0.0; }, 0);
    return {inflow_h * inflow_u / u, u};
  }

  // Velocity at the angle zeta of the arc of a layer without thickness that entered the arc with u0.
  double thin_velocity(double zeta, double u0) const {
    const double kappa = angle / arc, share = 1 + 4 * mu * mu;
    const double p = 6 * gravity * mu / (kappa * share), q = 2 * gravity / kappa * (1 - 2 * mu * mu) / share;
    const double c = u0 * u0 - p * std::sin(angle) - q * std::cos(angle);
    return std::sqrt(p * std::sin(zeta) + q * std::cos(zeta) + c * std::exp(2 * mu * (zeta - angle)));
  }

 private:
  template <class Zeta>
  double part(double u, double from, double to, Zeta&& zeta_at, double kappa) const {
    const int steps = 400;
    const double dx = (to - from) / steps;
    const auto rate = [&](double x, double v) {
      const double zeta = zeta_at(x), h = inflow_h * inflow_u / v, weight = gravity * std::cos(zeta);
      const double push = gravity * std::sin(zeta) - mu * (weight + (curvature ? kappa * v * v : 0.0));
      return (push - 0.5 * k * gravity * std::sin(zeta) * kappa * h) / (1 - k * weight * h / (v * v)) / v;
    };
    for (int n = 0; n < steps; ++n) {
      const double x = from + n * dx;
      const double k1 = rate(x, u), k2 = rate(x + dx / 2, u + dx / 2 * k1), k3 = rate(x + dx / 2, u + dx / 2 * k2),
                   k4 = rate(x + dx, u + dx * k3);
      u += dx / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return u;
  }
};

}  // namespace couloir::exact
