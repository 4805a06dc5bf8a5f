#include "continuum/noc/nested/nest.hpp"

#include <algorithm>
#include <cmath>

namespace couloir::noc {
namespace {

struct Extent {
  int begin, end;  // in cells of the level, the rim included
  int rim_low, rim_high;
};

// No rim where the patch reaches the domain's side.
Extent extent(int low, int high, int cells, int rim) {
  const int below = low == 0 ? 0 : rim, above = high == cells ? 0 : rim;
  return {2 * low - below, 2 * high + above, below, above};
}

struct Layout {
  Extent x, y;
  Layout(const SolverSettings& s, const PatchPlace& p) {
    const int nx = s.grid.nx << (p.level - 1), ny = s.grid.ny << (p.level - 1), rim = rim_width(s.limiter);
    x = extent(p.foot.i0, p.foot.i1, nx, rim), y = extent(p.foot.j0, p.foot.j1, ny, rim);
  }
};

SolverSettings settings_of(SolverSettings s, const PatchPlace& p) {
  s.refinement = {};
  if (p.level == 0) return s;
  const Layout at(s, p);
  const Grid base = s.grid;
  const double size = std::ldexp(1.0, -p.level);
  s.grid.nx = at.x.end - at.x.begin, s.grid.ny = at.y.end - at.y.begin;
  s.grid.dx = size * base.dx, s.grid.dy = size * base.dy;
  s.grid.x0 = base.x0 + at.x.begin * s.grid.dx, s.grid.y0 = base.y0 + at.y.begin * s.grid.dy;
  const bool rimmed[] = {at.x.rim_low > 0, at.x.rim_high > 0, at.y.rim_low > 0, at.y.rim_high > 0};
  for (int side = 0; side < 4; ++side) {
    if (rimmed[side]) s.sides[side] = {};  // what comes from beyond the rim does not get through it
  }
  return s;
}

}  // namespace

Nest::Nest(const SolverSettings& s, const ReferenceSurface& surface, const NocBed& bed, const NocSettings& own,
           const PatchPlace& p, const Nest* parent)
    : solver(settings_of(s, p), surface, bed, own), level(p.level) {
  inside = {0, solver.grid().nx, 0, solver.grid().ny};
  if (!parent) return;
  const Layout at(s, p);
  inside = {at.x.rim_low, inside.i1 - at.x.rim_high, at.y.rim_low, inside.j1 - at.y.rim_high};
  i0 = at.x.begin, j0 = at.y.begin;
  shift_i_ = i0 - 2 * parent->i0, shift_j_ = j0 - 2 * parent->j0;
  foot = {p.foot.i0 - parent->i0, p.foot.i1 - parent->i0, p.foot.j0 - parent->j0, p.foot.j1 - parent->j0};
  lay_rim(*parent, s.sides);
}

void Nest::lay_rim(const Nest& parent, const std::array<Side, 4>& sides) {
  const Grid &g = solver.grid(), &coarse = parent.solver.grid();
  // Beyond the domain's side: the other end where it is periodic, else the last one.
  const auto place = [](int i, int n, const Side& side) {
    return side.kind == Side::Kind::periodic ? (i + n) % n : std::clamp(i, 0, n - 1);
  };
  const auto half = [](int i) { return i >> 1; };
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      if (inside.contains(i, j)) continue;
      const int fine_i = i + shift_i_, fine_j = j + shift_j_;
      RimCell c{
          i,  j, half(fine_i), half(fine_i) + (fine_i % 2 == 0 ? -1 : 1), half(fine_j), half(fine_j) + (fine_j % 2 == 0 ? -1 : 1),
          {}, {}};
      c.far_i = place(c.far_i, coarse.nx, sides[0]), c.far_j = place(c.far_j, coarse.ny, sides[2]);
      rim_.push_back(c);
    }
  }
}

// So written that equal states give themselves, and depths stay positive.
FlowState Nest::from_parent(const RimCell& c, const NocSolver& parent) const {
  const auto towards = [](const FlowState& a, const FlowState& b) {
    return FlowState{a.h + 0.25 * (b.h - a.h), a.hu + 0.25 * (b.hu - a.hu), a.hv + 0.25 * (b.hv - a.hv)};
  };
  const auto along = [&](int j) { return towards(parent.at(c.near_i, j), parent.at(c.far_i, j)); };
  return towards(along(c.near_j), along(c.far_j));
}

void Nest::read_start(const Nest& parent) {
  for (RimCell& c : rim_) c.start = from_parent(c, parent.solver);
}

void Nest::read_end(const Nest& parent) {
  for (RimCell& c : rim_) c.end = from_parent(c, parent.solver);
}

void Nest::fill_rim(double w) {
  for (const RimCell& c : rim_) {
    const FlowState &a = c.start, &b = c.end;
    solver.set(c.i, c.j, {a.h + w * (b.h - a.h), a.hu + w * (b.hu - a.hu), a.hv + w * (b.hv - a.hv)});
  }
}

// Pairs across y first: mirrored scenes give mirrored bits.
FlowState Nest::mean_over(int i, int j) const {
  const int fi = 2 * i - shift_i_, fj = 2 * j - shift_j_;
  const FlowState ll = solver.at(fi, fj), lh = solver.at(fi, fj + 1), hl = solver.at(fi + 1, fj), hh = solver.at(fi + 1, fj + 1);
  const auto mean = [](double a, double b, double c, double d) { return 0.25 * ((a + b) + (c + d)); };
  return {mean(ll.h, lh.h, hl.h, hh.h), mean(ll.hu, lh.hu, hl.hu, hh.hu), mean(ll.hv, lh.hv, hl.hv, hh.hv)};
}

CellBox Nest::covered(const CellBox& b) const {
  return {std::max(b.i0, foot.i0), std::min(b.i1, foot.i1), std::max(b.j0, foot.j0), std::min(b.j1, foot.j1)};
}

CellBox Nest::finer(const CellBox& b) const {
  return {2 * b.i0 - shift_i_, 2 * b.i1 - shift_i_, 2 * b.j0 - shift_j_, 2 * b.j1 - shift_j_};
}

}  // namespace couloir::noc
