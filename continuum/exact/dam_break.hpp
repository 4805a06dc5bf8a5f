#pragma once
// Dam breaks: at t = 0 a depth h0 at rest for x < 0, less or nothing for x > 0. K = 1.

#include <cmath>

#include "continuum/exact/depth_velocity.hpp"

namespace couloir::exact {

// On an incline with Coulomb friction, tan(zeta) >= tan(delta) (Mangeney, Heinrich, Roche 2000); m = g' (tan(zeta) - tan(delta))
// [m/s2] is what drives it and g' = g cos(zeta). m = 0: Ritter's solution. t > 0.
inline DepthVelocity dam_break_dry(double x, double t, double h0, double weight, double m = 0) {
  const double c0 = std::sqrt(weight * h0);
  if (x <= (0.5 * m * t - c0) * t) return {h0, m * t};
  if (x >= (2 * c0 + 0.5 * m * t) * t) return {};
  const double root = 2 * c0 - x / t + 0.5 * m * t;
  return {root * root / (9 * weight), 2.0 / 3.0 * (c0 + x / t + m * t)};
}

// Onto a layer h1 at rest, 0 < h1 < h0 (Stoker 1957): a rarefaction, a plateau and a shock. Built once, then asked at (x, t).
class StokerDamBreak {
 public:
  StokerDamBreak(double h0, double h1, double weight) : h0_(h0), h1_(h1), g_(weight) {
    // The plateau's depth: its velocity behind the shock is the one at the end of the rarefaction.
    double low = h1, high = h0;
    for (int k = 0; k < 200; ++k) {
      const double mid = 0.5 * (low + high);
      (behind_shock(mid) < behind_rarefaction(mid) ? low : high) = mid;
    }
    h_ = 0.5 * (low + high);
    u_ = behind_rarefaction(h_);
    shock_ = u_ * h_ / (h_ - h1_);
  }

  DepthVelocity at(double x, double t) const {
    const double s = x / t, c0 = std::sqrt(g_ * h0_);
    if (s <= -c0) return {h0_, 0};
    if (s <= u_ - std::sqrt(g_ * h_)) return {(2 * c0 - s) * (2 * c0 - s) / (9 * g_), 2.0 / 3.0 * (c0 + s)};
    if (s <= shock_) return {h_, u_};
    return {h1_, 0};
  }
  double shock_speed() const { return shock_; }

 private:
  double behind_shock(double h) const { return (h - h1_) * std::sqrt(0.5 * g_ * (h + h1_) / (h * h1_)); }
  double behind_rarefaction(double h) const { return 2 * (std::sqrt(g_ * h0_) - std::sqrt(g_ * h)); }

  double h0_, h1_, g_, h_ = 0, u_ = 0, shock_ = 0;
};

}  // namespace couloir::exact
