#pragma once
// A point gives all it holds to its four quadrants, and each quadrant belongs to one point of the other lattice: (3.12) read by
// giver. The four shares of one point sum to what it holds, whatever slopes and fluxes are; so mass is kept by construction,
// and a share may be limited without harm.
//
//   +---+---+
//   | . | . |   share(cx, cy) = w/4 + (cx sx dx/4 + cy sy dy/4) / 4 + dt/2 (cx f/dx + cy g/dy),  cx, cy = -1, +1
//   +---o---+
//   | . | . |
//   +---+---+
//
// All of it pointwise: the inner loops of receive.cpp and the sides, control boxes and counts take the same functions, so that
// they decide alike to the bit.

#include <cmath>

#include "continuum/flow/friction.hpp"
#include "continuum/noc/points.hpp"
#include "continuum/scheme/min_max.hpp"

namespace couloir::noc {

// std::hypot guards against overflow at many times the cost.
[[gnu::always_inline]] inline double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

[[gnu::always_inline]] inline double share_depth(const Point& p, double cx, double cy) {
  return 0.25 * p.q.h + (cx * p.tilt_x.h + cy * p.tilt_y.h);
}

[[gnu::always_inline]] inline FlowState share(const Point& p, double cx, double cy) {
  return {share_depth(p, cx, cy), 0.25 * p.q.hu + (cx * p.tilt_x.hu + cy * p.tilt_y.hu),
          0.25 * p.q.hv + (cx * p.tilt_x.hv + cy * p.tilt_y.hv)};
}

// Depth of a quadrant at the half time, (3.11) [m].
[[gnu::always_inline]] inline double quarter_depth(const Point& p, double cx, double cy) {
  return larger(0.0, p.half.h + cx * p.x.h + cy * p.y.h);
}

// The greatest part of slopes and fluxes at which none of the four shares takes more than there is.
inline double own_keep(const Point& p) {
  const double most = std::abs(p.tilt_x.h) + std::abs(p.tilt_y.h);
  constexpr double short_of_it = 1 - 1e-12;  // so that round-off leaves no share below zero
  return most > 0.25 * p.q.h ? short_of_it * (0.25 * p.q.h / most) : 1.0;
}

// Under a quadrant.
struct Ground {
  double weight = 0, drive = 0;   // g cos(zeta), g sin(zeta) [m/s2]
  double kappa = 0;               // [1/m]
  double rise_x = 0, rise_y = 0;  // of z_b
};

// What the flow meets everywhere.
struct Drag {
  double mu, dry;         // tan(delta) [-]; [m]
  bool friction, curved;  // constants in the inner loops
};

// What a receiver gets: its share, and beside it what acts on the quadrant at the half time (3.10), times dt/4.
struct Part {
  double h = 0, hu = 0, hv = 0;     // the share
  double x = 0, y = 0;              // by gravity and bed [m2/s]
  double brake = 0;                 // what Coulomb friction can take [m2/s]
  double along_x = 0, along_y = 0;  // of it, against the quadrant's own velocity
  double still = 0;                 // of it, where the quadrant is at rest: against whatever moves it
};

[[gnu::always_inline]] inline Part operator+(const Part& a, const Part& b) {
  return {a.h + b.h,         a.hu + b.hu,           a.hv + b.hv,           a.x + b.x,        a.y + b.y,
          a.brake + b.brake, a.along_x + b.along_x, a.along_y + b.along_y, a.still + b.still};
}

[[gnu::always_inline]] inline Part part_of(const Point& p, const Ground& g, const Drag& drag, double cx, double cy, double tau) {
  const double h = quarter_depth(p, cx, cy), part = 0.25 * tau;
  double brake = 0, along_x = 0, along_y = 0, still = 0;
  if (drag.friction) {
    const double thick = h >= drag.dry ? 1.0 : 0.0;
    const double mx = thick * (p.half.hu + cx * p.x.hu + cy * p.y.hu), my = thick * (p.half.hv + cx * p.x.hv + cy * p.y.hv);
    const double momentum = length(mx, my), per = momentum > 0 ? 1 / momentum : 0.0;
    const double u = drag.curved ? mx * per * smaller(momentum / (thick > 0 ? h : 1.0), p.reach) : 0.0;
    brake = coulomb_capacity(part, drag.mu, g.weight, g.kappa, u, h);
    along_x = brake * (mx * per), along_y = brake * (my * per);
    still = momentum > 0 ? 0.0 : brake;
  }
  const FlowState s = share(p, cx, cy);
  return {s.h,     s.hu,    s.hv, part * h * (g.drive - g.weight * g.rise_x), part * h * (-g.weight * g.rise_y), brake,
          along_x, along_y, still};
}

// Friction, film and the bound of the speed on the momentum that all other terms give.
struct Settled {
  double hu = 0, hv = 0;
  double friction_x = 0, friction_y = 0, cutoff_x = 0, cutoff_y = 0;  // what they took, with its sign
};

inline bool moves(const Part& all, double momentum, bool held) {
  return !held && momentum > all.brake;
}

// all: the sum of four parts; reach: the greatest of their givers; held: all of these are locked.
[[gnu::always_inline]] inline Settled settle(const Part& all, double reach, double held, const Drag& drag) {
  const double hu = all.hu + all.x, hv = all.hv + all.y;
  double left_x = held > 0 ? 0.0 : hu, left_y = held > 0 ? 0.0 : hv;
  if (drag.friction) {
    // As (3.10) has it; and no larger than what it brakes, so that nothing is turned round.
    const double momentum = length(hu, hv), per = all.still / (momentum > 0 ? momentum : 1.0);
    const double free = momentum > all.brake ? 1.0 : 0.0;
    left_x = free * (1 - held) > 0 ? hu - (all.along_x + per * hu) : 0.0;
    left_y = free * (1 - held) > 0 ? hv - (all.along_y + per * hv) : 0.0;
  }
  const double speed = length(left_x, left_y), most = reach * all.h;
  const double kept = all.h < drag.dry ? 0.0 : speed > most ? most / (speed > 0 ? speed : 1.0) : 1.0;
  Settled s;
  s.hu = kept * left_x, s.hv = kept * left_y;
  s.friction_x = left_x - hu, s.friction_y = left_y - hv;
  s.cutoff_x = s.hu - left_x, s.cutoff_y = s.hv - left_y;
  return s;
}

}  // namespace couloir::noc
