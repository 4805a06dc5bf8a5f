// Ghost values of a lattice: what its slopes see beyond the domain's sides.

#include <algorithm>

#include "continuum/noc/lattice.hpp"

namespace couloir::noc {

GhostSource ghost_source(int i, int n, Lattice::Kind kind, const Side& low, const Side& high) {
  if (i >= 0 && i < n) return {i};
  const bool below = i < 0, corners = kind == Lattice::Kind::corners;
  const Side& side = below ? low : high;
  const int beyond = below ? -i : i - (n - 1);  // 1, 2
  const int inward = corners ? beyond : beyond - 1;
  const int mirrored = std::clamp(below ? inward : n - 1 - inward, 0, n - 1), last = below ? 0 : n - 1;
  const int period = corners ? n - 1 : n;
  switch (side.kind) {
    case Side::Kind::wall:
      return {mirrored, true};
    case Side::Kind::periodic:
      return {(i % period + period) % period};
    case Side::Kind::inflow:
      return {last, false, true};
    case Side::Kind::outflow:
      break;
  }
  return {last, false, false, true};
}

// Rows first, then columns over the whole height, so that the corners' ghosts are mirrored twice.
void Lattice::fill_ghosts() {
  const auto copy = [&](int to, int from, const GhostSource& g, int side, double* normal, double outward) {
    const Side& s = s_.sides[side];
    q.h[to] = g.fixed ? s.depth : q.h[from];
    q.hu[to] = g.fixed ? 0.0 : q.hu[from];
    q.hv[to] = g.fixed ? 0.0 : q.hv[from];
    if (g.fixed) normal[to] = -outward * s.depth * s.velocity;
    if (g.mirrored || (g.one_way && outward * normal[from] < 0)) normal[to] = -normal[from];
  };
  const int beyond_x[] = {-1, -2, nx_, nx_ + 1}, beyond_y[] = {-1, -2, ny_, ny_ + 1};
  for (int i : beyond_x) {
    const GhostSource g = ghost_source(i, nx_, kind_, s_.sides[0], s_.sides[1]);
    for (int j = 0; j < ny_; ++j) copy(at(i, j), at(g.index, j), g, i < 0 ? 0 : 1, q.hu, i < 0 ? -1 : 1);
  }
  for (int j : beyond_y) {
    const GhostSource g = ghost_source(j, ny_, kind_, s_.sides[2], s_.sides[3]);
    for (int i = -ghosts; i < nx_ + ghosts; ++i) copy(at(i, j), at(i, g.index), g, j < 0 ? 2 : 3, q.hv, j < 0 ? -1 : 1);
  }
}

}  // namespace couloir::noc
