#pragma once
// Exchange through one face of an edge between two planes, pointwise. Seen unfolded: what leaves one plane across the edge
// arrives on the other with its velocity turned into that plane. Mass is exchanged, not copied; momentum is turned, and what
// turns it is the edge's reaction.
//
//   concave: slope (1) -> front plane (2)          convex: front (1) -> top, front (1) -> side, ... (2)
//
//            | 2  w up                                      2  ------>
//            |                                            __________
//    u       |                                           |
//   -->      |                                         1 | ^
//   _________|  1
//
// The concave edge passes on the share eta of the velocity. Pressure lifts nothing up the wall: the wall bears it. So material at
// rest before the wall stays at rest, and with eta = 0 the edge is a wall.

#include <algorithm>
#include <cmath>

#include "continuum/scheme/hll.hpp"

namespace couloir {

// The cell of one plane at an edge: velocity towards the edge and along it [m/s], g = K times the plane's weight [m/s2].
struct EdgeCell {
  double h = 0, toward = 0, along = 0, g = 0;
};

// Per unit length of the edge; mass and along positive from plane 1 to plane 2. normal_1, normal_2: how much momentum towards the
// edge each plane gives to it (pressure included); never negative at a concave edge.
struct EdgeFlux {
  double mass = 0;                    // [m2/s]
  double along = 0;                   // [m3/s2]
  double normal_1 = 0, normal_2 = 0;  // [m3/s2]
};

// A stream that leaves a plane over a concave edge.
struct EdgeStream {
  double mass = 0;      // [m2/s]
  double normal = 0;    // [m3/s2] momentum and pressure that its plane gives to the edge
  double velocity = 0;  // [m/s] with which it leaves the edge on the other plane
};

// From the slope up a plane: the edge is a gate that the flow passes at eta u, so in the frame of that outlet a wall that the
// flow meets with (1 - eta) u (HLL, as wall_flux). Where the flow is too fast for a shock to stay before the edge, all of it
// passes.
inline EdgeStream stream_up(const EdgeCell& q, double eta) {
  if (!(q.toward > 0)) return {0, wall_flux(q.h, q.toward, q.g), 0};
  const double u = q.toward, out = eta * u, excess = u - out, c = std::sqrt(q.g * q.h);
  if (out >= excess + c) return {q.h * u, q.h * u * u + pressure(q.h, q.g), out};
  const double piled = excess > 0 ? q.h * (1 + excess / (excess + c)) : q.h;  // depth behind the shock
  return {piled * out, piled * out * out + wall_flux(q.h, excess, q.g), out};
}

// From a plane down to the slope: all that falls passes, at the share eta of its velocity. What lies on the plane is borne as far
// up as the slope's own depth reaches; what reaches higher flows out below.
inline EdgeStream stream_down(const EdgeCell& q, double eta, double depth_below) {
  const NormalFlux n = hll(q.h, q.toward, q.g, std::min(q.h, depth_below), q.toward, q.g);
  if (!(n.mass > 0)) return {0, wall_flux(q.h, q.toward, q.g), 0};
  return {n.mass, n.momentum, eta * std::max(q.toward, 0.0)};
}

// Pressure in an arriving stream; no more than half of its own momentum flux, where the stream is not supercritical.
inline double arriving_pressure(const EdgeStream& s, double g) {
  if (!(s.velocity > 0)) return 0;
  return std::min(pressure(s.mass / s.velocity, g), 0.5 * s.mass * s.velocity);
}

// slope: plane 1, plane: plane 2. most_up, most_down: greatest mass that the two cells can give [m2/s].
inline EdgeFlux concave_edge(const EdgeCell& slope, const EdgeCell& plane, double eta, double most_up, double most_down) {
  EdgeStream up = stream_up(slope, eta), down = stream_down(plane, eta, slope.h);
  up.mass = std::min(up.mass, most_up);
  down.mass = std::min(down.mass, most_down);
  return {up.mass - down.mass, up.mass * slope.along - down.mass * plane.along,
          std::max(up.normal, arriving_pressure(down, slope.g)) + down.mass * down.velocity,
          std::max(down.normal, arriving_pressure(up, plane.g)) + up.mass * up.velocity};
}

// The two planes as one unfolded sheet.
inline EdgeFlux convex_edge(const EdgeCell& one, const EdgeCell& two, double most_1, double most_2) {
  NormalFlux n = hll(one.h, one.toward, one.g, two.h, -two.toward, two.g);
  const double most = n.mass > 0 ? most_1 : most_2;
  if (std::abs(n.mass) > most) {
    n.momentum *= most / std::abs(n.mass);
    n.mass = std::copysign(most, n.mass);
  }
  return {n.mass, n.mass * (n.mass > 0 ? one.along : two.along), n.momentum, n.momentum};
}

// Out of a plane without weight into the air.
inline EdgeFlux free_edge(const EdgeCell& one, double most) {
  const double mass = std::min(one.h * std::max(one.toward, 0.0), most);
  return {mass, mass * one.along, mass * one.toward, 0};
}

}  // namespace couloir
