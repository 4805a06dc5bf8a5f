#pragma once
// A point gives all it holds to its four quadrants, and each quadrant belongs to one point of the other lattice: (3.12) read by
// giver. The four shares of one point sum to what it holds, whatever slopes and fluxes are; so mass is kept by construction,
// and a share may be limited without harm.
//
//   +---+---+
//   | . | . |   share(cx, cy) = w/4 + keep [ (cx sx dx/4 + cy sy dy/4) / 4 + dt/2 (cx f/dx + cy g/dy) ],  cx, cy = -1, +1
//   +---o---+
//   | . | . |
//   +---+---+

#include "continuum/noc/lattice.hpp"

namespace couloir::noc {

// cx w_x + cy w_y of one quantity: what a quadrant gets beside its quarter.
inline double tilt(double x, double y, double flux_x, double flux_y, double cx, double cy) {
  return 0.25 * (cx * x + cy * y) + (cx * flux_x + cy * flux_y);
}

inline double share_depth(const Point& p, double cx, double cy) {
  return 0.25 * p.q.h + p.keep * tilt(p.x.h, p.y.h, p.flux_x.h, p.flux_y.h, cx, cy);
}

inline FlowState share(const Point& p, double cx, double cy) {
  return {share_depth(p, cx, cy), 0.25 * p.q.hu + p.keep * tilt(p.x.hu, p.y.hu, p.flux_x.hu, p.flux_y.hu, cx, cy),
          0.25 * p.q.hv + p.keep * tilt(p.x.hv, p.y.hv, p.flux_x.hv, p.flux_y.hv, cx, cy)};
}

// The greatest keep at which none of the four shares takes more than there is.
double own_keep(const Point&);

// Depth of a quadrant at the half time, (3.11) [m].
inline double quarter_depth(const Point& p, double cx, double cy) {
  const double h = p.half.h + cx * p.x.h + cy * p.y.h;
  return h > 0 ? h : 0.0;
}

// What acts on a quadrant at the half time (3.10), times dt/4.
struct Push {
  double x = 0, y = 0;              // gravity and bed [m2/s]
  double brake = 0;                 // what Coulomb friction can take [m2/s]
  double along_x = 0, along_y = 0;  // of it, against the quadrant's own velocity
  double still = 0;                 // of it, where the quadrant is at rest: against whatever moves it
};
Push push(const Point&, const Terrain&, int k, int l, double cx, double cy, double tan_delta, double dry_depth, double tau);

}  // namespace couloir::noc
