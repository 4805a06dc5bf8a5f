#pragma once
// Thacker's plane motion (1981) in a parabolic basin z = h0 x^2 / a^2, frictionless, K = 1: the surface stays a plane, the
// shoreline swings to and fro with omega^2 = 2 g h0 / a^2.

#include <algorithm>
#include <cmath>

namespace couloir::exact {

struct ThackerBasin {
  double h0, a, swing, gravity;  // [m], [m], amplitude of the centre's motion [m], [m/s2]

  double omega() const { return std::sqrt(2 * gravity * h0) / a; }
  double bed(double x) const { return h0 * x * x / (a * a); }
  double centre(double t) const { return swing * std::cos(omega() * t); }
  double velocity(double t) const { return -swing * omega() * std::sin(omega() * t); }
  double depth(double x, double t) const {
    const double s = (x - centre(t)) / a;
    return std::max(0.0, h0 * (1 - s * s));
  }
};

}  // namespace couloir::exact
