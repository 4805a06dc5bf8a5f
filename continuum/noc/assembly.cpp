// The corrector (3.12) point by point: on the domain's sides, and for those who count. receive.cpp has the inner loops.

#include <algorithm>

#include "continuum/noc/noc_impl.hpp"
#include "continuum/scheme/effects.hpp"

namespace couloir {

using noc::length;
using noc::Part;

noc::Drag NocSolver::Impl::drag() const {
  const double mu = settings.closure.tan_delta;
  return {mu, settings.dry_depth, built::friction && mu > 0, built::curvature && !terrain.arc().empty()};
}

noc::Ground NocSolver::Impl::ground(int k, int l) const {
  const noc::Gradient bed = built::relief ? terrain.slope(k, l) : noc::Gradient{};
  return {terrain.weight(k), terrain.drive(k), built::curvature ? terrain.kappa(k) : 0.0, bed.x, bed.y};
}

// Column (row) `corner` of the corners has the cells corner - 1 and corner as givers: which = 0, 1.
NocSolver::Impl::Line NocSolver::Impl::line(int corner, int which, int cells, int low_side) const {
  const int c = corner - 1 + which;
  const double own = which == 0 ? 1 : -1;  // the lower cell gives by its upper quadrants
  if (c >= 0 && c < cells) return {c, own, 1, true};
  const int side = c < 0 ? low_side : low_side + 1, last = c < 0 ? 0 : cells - 1;
  switch (settings.sides[side].kind) {
    case Side::Kind::wall:
      return {last, -own, -1, false};
    case Side::Kind::periodic:
      return {c < 0 ? cells - 1 : 0, own, 1, true};
    case Side::Kind::inflow:
      return {last, own, 1, false, -1, side};
    case Side::Kind::outflow:
      break;
  }
  return {last, own, 1, false, side};
}

NocSolver::Impl::Giver NocSolver::Impl::giver(int i, int j, int a, int b) const {
  Line x = lines_x[2 * i + a], y = lines_y[2 * j + b];
  const int c = centres.at(x.index, y.index);
  const Point p = centres.point(c);
  // Beyond an outflow: the last cell again while it flows out, now and at the half time; else a wall, so that nothing comes in.
  const auto close = [](Line& l, double now, double half) {
    const double outward = l.outflow % 2 == 0 ? -1 : 1;
    if (!(outward * now > 0 && outward * half > 0)) l.corner = -l.corner, l.flip = -1;
  };
  if (x.outflow >= 0) close(x, p.q.hu, p.half.hu);
  if (y.outflow >= 0) close(y, p.q.hv, p.half.hv);
  Giver g{p,
          c,
          x.corner,
          y.corner,
          x.flip,
          y.flip,
          2 * x.index + (x.corner > 0),
          2 * y.index + (y.corner > 0),
          x.inside && y.inside,
          centres.locked[c]};
  const int side = x.inflow >= 0 ? x.inflow : y.inflow;
  if (side >= 0) g.p = inflow[side], g.source = -1, g.locked = settings.sides[side].depth < settings.dry_depth;
  return g;
}

bool NocSolver::Impl::on_side(int i, int j) const {
  const Grid& g = settings.grid;
  return ((i == 0 || i == g.nx) && settings.sides[0].kind != Side::Kind::periodic) ||
         ((j == 0 || j == g.ny) && settings.sides[2].kind != Side::Kind::periodic);
}

void NocSolver::Impl::book_side(int i, int j, double x, double y, Budget& book) const {
  const Grid& g = settings.grid;
  const bool along = (i == 0 || i == g.nx) && settings.sides[0].kind != Side::Kind::periodic;
  const bool across = (j == 0 || j == g.ny) && settings.sides[2].kind != Side::Kind::periodic;
  const int end = i == 0 ? 0 : 1, flank = j == 0 ? 2 : 3;
  book.boundary[0] += x, book.boundary[1] += y;
  book.sides[along ? end : flank][0] += x;
  book.sides[across ? flank : end][1] += y;
}

bool NocSolver::Impl::on_open_side(int i, int j) const {
  const Grid& g = settings.grid;
  const bool at[] = {i == 0, i == g.nx, j == 0, j == g.ny};
  for (int side = 0; side < 4; ++side) {
    const Side::Kind kind = settings.sides[side].kind;
    if (at[side] && (kind == Side::Kind::outflow || kind == Side::Kind::inflow)) return true;
  }
  return false;
}

// Of a corner on a side: what friction took from the part inside; the wall gets the rest. Where all is held, friction carries the
// weight before the wall does: what stands still at a wall pushes it with its pressure alone.
std::array<double, 2> NocSolver::Impl::friction_inside(const Settled& s, const Gathered& got, const Part& in, double portion) {
  const double momentum = length(got.hu(), got.hv());
  if (noc::moves(got.all, momentum, got.held > 0)) {
    return {-(in.along_x + in.still * (got.hu() / momentum)), -(in.along_y + in.still * (got.hv() / momentum))};
  }
  const auto rest = [&](double friction, double inside, double total) {
    return portion * friction - std::clamp(inside - portion * total, -in.brake, in.brake);
  };
  return {rest(s.friction_x, in.x, got.all.x), rest(s.friction_y, in.y, got.all.y)};
}

// Pairs across y first, then across x: mirrored scenes give mirrored bits.
void NocSolver::Impl::Gathered::add_up() {
  all = (part[0][0] + part[0][1]) + (part[1][0] + part[1][1]);
}

NocSolver::Impl::Gathered NocSolver::Impl::gather_corner(int i, int j, double tau) const {
  Gathered got;
  for (int a : {0, 1}) {
    for (int b : {0, 1}) {
      const Giver g = giver(i, j, a, b);
      Part& p = got.part[a][b];
      p = part_of(g.p, ground(g.k, g.l), drag(), g.cx, g.cy, tau);
      if (g.source < 0) p = {p.h, p.hu, p.hv};  // what comes in has no weight yet
      p.hu *= g.flip_x, p.x *= g.flip_x, p.along_x *= g.flip_x;
      p.hv *= g.flip_y, p.y *= g.flip_y, p.along_y *= g.flip_y;
      got.reach = std::max(got.reach, g.p.reach);
      got.held *= g.locked;
      got.inside[a][b] = g.inside;
    }
  }
  got.add_up();
  return got;
}

void NocSolver::Impl::update_corner(int i, int j, double tau, RowSums& sums) {
  const Gathered got = gather_corner(i, j, tau);
  const Settled s = settle(got);
  const int c = corners.at(i, j);
  corners.q.h[c] = got.all.h, corners.q.hu[c] = s.hu, corners.q.hv[c] = s.hv;
  corners.locked[c] = got.held;
  corners.lost_x[c] = s.friction_x + s.cutoff_x, corners.lost_y[c] = s.friction_y + s.cutoff_y;

  Part in;  // of those inside
  int inside = 0;
  for (int a : {0, 1}) {
    for (int b : {0, 1}) {
      if (got.inside[a][b]) in = in + got.part[a][b], ++inside;
    }
  }
  const double portion = 0.25 * inside;
  const auto friction = friction_inside(s, got, in, portion);
  Budget& book = sums.budget;
  book.gravity[0] += in.x, book.gravity[1] += in.y;
  book.friction[0] += friction[0], book.friction[1] += friction[1];
  book.cutoff[0] += portion * s.cutoff_x, book.cutoff[1] += portion * s.cutoff_y;
  // What a corner on a side got from inside went out; what it gives back comes in with the other half step.
  book_side(i, j, -(in.hu + in.x + friction[0] + portion * s.cutoff_x), -(in.hv + in.y + friction[1] + portion * s.cutoff_y),
            book);
  sums.note(got.all.h, s.hu, s.hv);
}

double NocSolver::Impl::share_to_centre(int i, int j, int a, int b) const {
  const double cx = a == 0 ? 1 : -1, cy = b == 0 ? 1 : -1;
  const int n = corners.at(i + a, j + b);
  return noc::share_back(corners.point(n), centres.point(centres.at(i, j)), corners.locked[n], cx, cy);
}

void NocSolver::Impl::book_centre(int i, int j, RowSums& sums) const {
  for (int a : {0, 1}) {
    for (int b : {0, 1}) {
      if (!on_side(i + a, j + b)) continue;
      const FlowState back = share(corners.point(corners.at(i + a, j + b)), 1 - 2 * a, 1 - 2 * b);
      book_side(i + a, j + b, back.hu, back.hv, sums.budget);
    }
  }
}

}  // namespace couloir
