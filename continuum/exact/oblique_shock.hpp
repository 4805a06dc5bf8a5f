#pragma once
// A supercritical uniform flow that a wall turns by theta: the shock stands at beta to the incoming flow (Gray and Cui 2007).
//
//   eta = h2/h1 = (sqrt(1 + 8 F^2 sin^2 beta) - 1) / 2 = tan(beta) / tan(beta - theta)
//   F2 = |u2| / sqrt(g' h2),  |u2| = |u1| cos(beta) / cos(beta - theta)
//
// The weaker of the two solutions; none beyond theta_max, where the shock detaches. K = 1; with friction as long as delta = zeta.

#include <cmath>
#include <limits>

namespace couloir::exact {

struct ObliqueShock {
  double beta = std::numeric_limits<double>::quiet_NaN();  // [rad]; NaN where the shock is detached
  double eta = std::numeric_limits<double>::quiet_NaN();
  double froude_behind = std::numeric_limits<double>::quiet_NaN();
};

inline double oblique_depth_ratio(double froude, double beta) {
  const double s = froude * std::sin(beta);
  return 0.5 * (std::sqrt(1 + 8 * s * s) - 1);
}

// The turning angle theta that a shock at beta makes [rad].
inline double oblique_turning(double froude, double beta) {
  return beta - std::atan(std::tan(beta) / oblique_depth_ratio(froude, beta));
}

// The shock of the greatest turning: {beta, theta_max} [rad]; by golden section, froude > 1.
struct DetachedLimit {
  double beta, theta;
};
inline DetachedLimit oblique_limit(double froude) {
  double low = std::asin(1 / froude), high = 2 * std::atan(1.0);
  const double share = 0.5 * (std::sqrt(5.0) - 1);
  for (int n = 0; n < 120; ++n) {
    const double a = high - share * (high - low), b = low + share * (high - low);
    (oblique_turning(froude, a) < oblique_turning(froude, b) ? low : high) =
        oblique_turning(froude, a) < oblique_turning(froude, b) ? a : b;
  }
  return {0.5 * (low + high), oblique_turning(froude, 0.5 * (low + high))};
}

inline ObliqueShock oblique_shock(double froude, double theta) {
  const DetachedLimit limit = oblique_limit(froude);
  if (theta > limit.theta) return {};
  double low = std::asin(1 / froude), high = limit.beta;
  for (int n = 0; n < 200; ++n) {
    const double beta = 0.5 * (low + high);
    (oblique_turning(froude, beta) < theta ? low : high) = beta;
  }
  const double beta = 0.5 * (low + high), eta = oblique_depth_ratio(froude, beta);
  return {beta, eta, froude * std::cos(beta) / std::cos(beta - theta) / std::sqrt(eta)};
}

}  // namespace couloir::exact
