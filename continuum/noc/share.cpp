#include "continuum/noc/share.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/flow/friction.hpp"
#include "continuum/scheme/effects.hpp"

namespace couloir::noc {

double own_keep(const Point& p) {
  double most = 0;
  for (double cx : {-1.0, 1.0}) {
    for (double cy : {-1.0, 1.0}) most = std::max(most, -tilt(p.x.h, p.y.h, p.flux_x.h, p.flux_y.h, cx, cy));
  }
  constexpr double short_of_it = 1 - 1e-12;  // so that round-off leaves no share below zero
  return most > 0.25 * p.q.h ? short_of_it * (0.25 * p.q.h / most) : 1.0;
}

Push push(const Point& p, const Terrain& t, int k, int l, double cx, double cy, double tan_delta, double dry_depth, double tau) {
  Push out;
  const double h = quarter_depth(p, cx, cy), part = 0.25 * tau;
  const Gradient bed = built::relief ? t.slope(k, l) : Gradient{};
  out.x = part * h * (t.drive(k) - t.weight(k) * bed.x);
  out.y = part * h * (-t.weight(k) * bed.y);
  if (!built::friction || !(tan_delta > 0)) return out;
  double u = 0, v = 0, speed = 0;
  if (h >= dry_depth) {
    u = (p.half.hu + cx * p.x.hu + cy * p.y.hu) / h, v = (p.half.hv + cx * p.x.hv + cy * p.y.hv) / h;
    speed = length(u, v);
    if (speed > p.reach) {
      const double fit = p.reach / speed;
      u *= fit, v *= fit, speed = p.reach;
    }
  }
  out.brake = coulomb_capacity(part, tan_delta, t.weight(k), built::curvature ? t.kappa(k) : 0.0, u, h);
  if (speed > 0) {
    out.along_x = out.brake * (u / speed), out.along_y = out.brake * (v / speed);
  } else {
    out.still = out.brake;
  }
  return out;
}

}  // namespace couloir::noc
