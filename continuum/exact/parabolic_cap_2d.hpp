#pragma once
// The parabolic cap on an elliptic base that spreads while it slides down an incline (Hutter, Siegel, Savage, Nohguchi 1993):
//
//   h = H a0 b0 / (a b) (1 - xi^2/a^2 - y^2/b^2),  u = u_c + xi a'/a,  v = y b'/b,  xi = x - x_c
//   a'' = 2 G_x H a0 b0 / (a^2 b),  b'' = 2 G_y H a0 b0 / (a b^2) - mu g' b' / u_c,  u_c = m t,  x_c = m t^2 / 2
//
// G_x = K_x g', G_y = K_y g', g' = g cos(zeta), m = g' (tan(zeta) - mu). In the scales of references 2c, g = a / a0 and f = b /
// b0. Without friction this is exact. With friction the direction u/|u| is taken as (1, v / u_c): the error is of the order of (v
// / u_c)^2 and of xi a' / (a u_c), which are not small at the start. b' starts as (2 G_y H / b0) m t / (m + mu g').

#include <array>
#include <cmath>

namespace couloir::exact {

class ParabolicCap2d {
 public:
  struct Shape {
    double a, b, da, db;  // half axes [m] and their rates [m/s]
  };

  // height H, half axes a0, b0 [m]; G_x, G_y, g' [m/s2]; angle zeta [rad]; mu <= tan(zeta).
  ParabolicCap2d(double height, double a0, double b0, double push_x, double push_y, double weight, double tan_zeta, double mu)
      : h0_(height), a0_(a0), b0_(b0), gx_(push_x), gy_(push_y), friction_(mu * weight), drive_(weight * (tan_zeta - mu)) {}

  // At time t [s]: Runge-Kutta of order 4, steps of t / 4000; the error is far below 1e-9.
  Shape shape(double t) const {
    std::array<double, 4> q{a0_, b0_, 0, 0};
    const int steps = 4000;
    const double dt = t / steps;
    for (int n = 0; n < steps; ++n) {
      const double now = n * dt;
      const auto k1 = rate(now, q), k2 = rate(now + dt / 2, sum(q, k1, dt / 2)), k3 = rate(now + dt / 2, sum(q, k2, dt / 2)),
                 k4 = rate(now + dt, sum(q, k3, dt));
      for (int k = 0; k < 4; ++k) q[k] += dt / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
    }
    return {q[0], q[1], q[2], q[3]};
  }
  double centre(double t) const { return 0.5 * drive_ * t * t; }  // [m] from where it started
  double velocity(double t) const { return drive_ * t; }          // of the centre [m/s]
  double peak(const Shape& s) const { return h0_ * a0_ * b0_ / (s.a * s.b); }
  double depth(double xi, double y, const Shape& s) const {
    const double r = xi * xi / (s.a * s.a) + y * y / (s.b * s.b);
    return r < 1 ? peak(s) * (1 - r) : 0.0;
  }

 private:
  using State = std::array<double, 4>;
  static State sum(State q, const State& k, double dt) {
    for (int n = 0; n < 4; ++n) q[n] += dt * k[n];
    return q;
  }
  State rate(double t, const State& q) const {
    const double p = 2 * h0_ * a0_ * b0_ / (q[0] * q[1]);
    const double start = gy_ * p / q[1] * drive_ / (drive_ + friction_);  // b'' as t goes to 0
    const double ddb = friction_ == 0 ? gy_ * p / q[1] : t > 0 ? gy_ * p / q[1] - friction_ * q[3] / (drive_ * t) : start;
    return {q[2], q[3], gx_ * p / q[0], ddb};
  }

  double h0_, a0_, b0_, gx_, gy_, friction_, drive_;
};

}  // namespace couloir::exact
