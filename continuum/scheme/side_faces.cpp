#include "continuum/scheme/side_faces.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/scheme/hll.hpp"

namespace couloir {
namespace {

// Calls f(side, face, inside cell, local column) for each face of this axis that lies on the domain's side.
template <class F>
void for_side_faces(const Block& b, const Axis& axis, F&& f) {
  const int low = axis.along_x ? 0 : 2;
  const bool at_low = axis.along_x ? b.i0 == 0 : b.j0 == 0;
  const bool at_high = axis.along_x ? b.i0 + b.nx == b.grid.nx : b.j0 + b.ny == b.grid.ny;
  const int n = axis.along_x ? b.ny : b.nx;
  for (int k = 0; k < n; ++k) {
    const int first = axis.along_x ? b.at(0, k) : b.at(k, 0);
    const int end = axis.along_x ? b.at(b.nx, k) : b.at(k, b.ny);
    if (at_low) f(low, first, first, axis.along_x ? 0 : k);
    if (at_high) f(low + 1, end, end - axis.step, axis.along_x ? b.nx : k);
  }
}

// q^2/h + g h^2/2, the momentum flux of a discharge q at depth h; least at the critical depth.
double specific_force(double q, double h, double g) {
  return q * q / h + pressure(h, g);
}

// Momentum that comes in with a discharge. What is slower than its waves takes the depth of the flow inside, or the critical
// one where that is less; what is faster brings its own, unless the flow inside is deep enough to drown it.
double inflow_momentum(double q, double depth, double inside, double g) {
  if (q == 0) return pressure(inside, g);
  const double critical = std::cbrt(q * q / g), drowned = specific_force(q, std::max(inside, critical), g);
  return depth > 0 && depth < critical ? std::max(specific_force(q, depth, g), drowned) : drowned;
}

}  // namespace

void side_fluxes(const Parameters& p, const Block& b, const Axis& axis, const FaceValues& v) {
  FaceFluxes& f = *axis.fluxes;
  for_side_faces(b, axis, [&](int side, int face, int inside, int column) {
    const bool low = side % 2 == 0;
    const double outward = low ? -1 : 1;
    const Side::Kind kind = p.sides[side].kind;
    if (p.comes_in(side)) {
      const double h = low ? v.h_lo[inside] : v.h_hi[inside], g = axis.k[inside] * axis.weight[column + Block::ghosts];
      f.mass[face] = -outward * p.discharge[side];
      f.tangent[face] = 0;
      f.normal[face] = f.normal_below[face] = f.normal_above[face] =
          inflow_momentum(p.discharge[side], p.inflow[side].depth, h, g);
      return;
    }
    const bool closed = p.wall(side) || (kind == Side::Kind::outflow && outward * axis.un[inside] < 0);
    if (!closed) return;
    const double h = low ? v.h_lo[inside] : v.h_hi[inside];
    const double u = outward * (low ? v.un_lo[inside] : v.un_hi[inside]);
    f.mass[face] = f.tangent[face] = 0;
    // wall_flux() as the faces inside work it out (face_flux.cpp), against the mirror image: so that what is the same all across
    // feels the same bits from wall and neighbour.
    const double g = axis.k[inside] * axis.weight[column + Block::ghosts], eta = low ? v.eta_lo[inside] : v.eta_hi[inside];
    const double over = b.relief ? std::max(0.0, std::min(h, eta - (eta - h))) : h;
    f.normal[face] = std::max(0.0, hll(over, u, g, over, -u, g).momentum + (pressure(h, g) - pressure(over, g)));
    f.normal_below[face] = f.normal_above[face] = f.normal[face];
  });
}

void count_sides(const Parameters& p, const Block& b, const BlockState& s, const Axis& axis, double share, Tally& t) {
  const FaceFluxes& f = *axis.fluxes;
  const int normal = axis.along_x ? 0 : 1;
  for_side_faces(b, axis, [&](int side, int face, int inside, int) {
    if (s.open[inside] == 0) return;
    const double inward = (side % 2 == 0 ? 1 : -1) * share * axis.face_length;
    t.budget.mass_boundary += inward * f.mass[face];
    if (p.sides[side].kind == Side::Kind::inflow) t.budget.mass_inflow += inward * f.mass[face];
    t.budget.boundary[normal] += inward * f.normal[face];
    t.budget.boundary[1 - normal] += inward * f.tangent[face];
    t.budget.sides[side][normal] += inward * f.normal[face];
    t.budget.sides[side][1 - normal] += inward * f.tangent[face];
  });
}

void rim_fluxes(const std::vector<RimFace>& rim, const CoveredZones& zones, const Axis& axis) {
  FaceFluxes& f = *axis.fluxes;
  for (const RimFace& r : rim) {
    if (r.along_x != axis.along_x) continue;
    const FaceFlux q = zones.zone(r.zone).actual(r.side, r.k, r.part, r.parts);
    f.mass[r.face] = q.mass;
    f.normal[r.face] = f.normal_below[r.face] = f.normal_above[r.face] = r.along_x ? q.mom_x : q.mom_y;
    f.tangent[r.face] = r.along_x ? q.mom_y : q.mom_x;
  }
}

}  // namespace couloir
