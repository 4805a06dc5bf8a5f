// The corrector (3.12): each point gathers four shares, then friction.

#include <algorithm>
#include <cmath>

#include "continuum/flow/flux.hpp"
#include "continuum/noc/noc_impl.hpp"

namespace couloir {

using noc::length;
using noc::Push;
using noc::share;
using noc::share_depth;

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
  const Point& p = centres.points[c];
  // Beyond an outflow: the last cell again while it flows out, now and at the half time; else a wall, so that nothing comes in.
  const auto close = [](Line& l, double now, double half) {
    const double outward = l.outflow % 2 == 0 ? -1 : 1;
    if (!(outward * now > 0 && outward * half > 0)) l.corner = -l.corner, l.flip = -1;
  };
  if (x.outflow >= 0) close(x, p.q.hu, p.half.hu);
  if (y.outflow >= 0) close(y, p.q.hv, p.half.hv);
  Giver g{&p,
          x.corner,
          y.corner,
          x.flip,
          y.flip,
          2 * x.index + (x.corner > 0),
          2 * y.index + (y.corner > 0),
          x.inside && y.inside,
          centres.locked[c] != 0};
  const int side = x.inflow >= 0 ? x.inflow : y.inflow;
  if (side >= 0) g.p = &inflow[side], g.locked = settings.sides[side].depth < settings.dry_depth;
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

bool NocSolver::Impl::counted(int i, int j) const {
  const Grid& g = settings.grid;
  return !(i == g.nx && settings.sides[0].kind == Side::Kind::periodic) &&
         !(j == g.ny && settings.sides[2].kind == Side::Kind::periodic);
}

NocSolver::Impl::Settled NocSolver::Impl::settle(const Gathered& got) const {
  const auto& [h, hu, hv] = got.sum;
  const Push& all = got.all;
  Settled s;
  const double momentum = length(hu, hv);
  if (!got.held && momentum > all.brake) {
    // As (3.10) has it; and no larger than what it brakes, so that nothing is turned round.
    s.hu = hu - (all.along_x + all.still * (hu / momentum));
    s.hv = hv - (all.along_y + all.still * (hv / momentum));
  }
  s.friction = {s.hu - hu, s.hv - hv};
  if (h < settings.dry_depth) {
    s.cutoff = {-s.hu, -s.hv};
    s.hu = s.hv = 0;
  } else if (const double speed = length(s.hu, s.hv) / h; speed > got.reach) {
    const double lost = got.reach / speed - 1;
    s.cutoff = {lost * s.hu, lost * s.hv};
    s.hu += s.cutoff[0], s.hv += s.cutoff[1];
  }
  return s;
}

// Of a corner on a side: what friction took from the part inside; the wall gets the rest. Where all is held, friction carries the
// weight before the wall does: what stands still at a wall pushes it with its pressure alone.
std::array<double, 2> NocSolver::Impl::friction_inside(const Settled& s, const Gathered& got, const Push& in, double portion) {
  const double momentum = length(got.sum.hu, got.sum.hv);
  if (!got.held && momentum > got.all.brake)
    return {-(in.along_x + in.still * (got.sum.hu / momentum)), -(in.along_y + in.still * (got.sum.hv / momentum))};
  const auto rest = [&](int k, double inside, double total) {
    return portion * s.friction[k] - std::clamp(inside - portion * total, -in.brake, in.brake);
  };
  return {rest(0, in.x, got.all.x), rest(1, in.y, got.all.y)};
}

// Pairs across y first, then across x: mirrored scenes give mirrored bits.
void NocSolver::Impl::Gathered::add_up() {
  const auto four = [](const auto& value) { return (value(0, 0) + value(0, 1)) + (value(1, 0) + value(1, 1)); };
  const auto total = [&](double Push::*member) { return four([&](int a, int b) { return push[a][b].*member; }); };
  all.x = total(&Push::x), all.y = total(&Push::y), all.brake = total(&Push::brake), all.still = total(&Push::still);
  all.along_x = total(&Push::along_x), all.along_y = total(&Push::along_y);
  sum.h = four([&](int a, int b) { return share[a][b].h; });
  sum.hu = four([&](int a, int b) { return share[a][b].hu; }) + all.x;
  sum.hv = four([&](int a, int b) { return share[a][b].hv; }) + all.y;
}

NocSolver::Impl::Gathered NocSolver::Impl::gather_corner(int i, int j, double tau) const {
  Gathered got;
  for (int a : {0, 1}) {
    for (int b : {0, 1}) {
      const Giver g = giver(i, j, a, b);
      FlowState& s = got.share[a][b];
      s = share(*g.p, g.cx, g.cy);
      s.hu *= g.flip_x, s.hv *= g.flip_y;
      const bool given = g.p < centres.points.data() || g.p >= centres.points.data() + centres.points.size();
      if (!given) {
        Push& f = got.push[a][b];
        f = push(*g.p, terrain, g.k, g.l, g.cx, g.cy, settings.closure.tan_delta, settings.dry_depth, tau);
        f.x *= g.flip_x, f.along_x *= g.flip_x;
        f.y *= g.flip_y, f.along_y *= g.flip_y;
      }
      got.reach = std::max(got.reach, g.p->reach);
      got.held = got.held && g.locked;
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
  corners.q.h[c] = got.sum.h, corners.q.hu[c] = s.hu, corners.q.hv[c] = s.hv;
  corners.locked[c] = got.held;

  if (!counted(i, j)) return;
  double in_hu = 0, in_hv = 0;
  Push in;  // of those inside
  int inside = 0;
  for (int a : {0, 1}) {
    for (int b : {0, 1}) {
      if (!got.inside[a][b]) continue;
      ++inside;
      const Push& f = got.push[a][b];
      in_hu += got.share[a][b].hu, in_hv += got.share[a][b].hv, in.x += f.x, in.y += f.y;
      in.brake += f.brake, in.along_x += f.along_x, in.along_y += f.along_y, in.still += f.still;
    }
  }
  const double portion = 0.25 * inside;
  const auto friction = inside == 4 ? s.friction : friction_inside(s, got, in, portion);
  Budget& book = sums.budget;
  book.gravity[0] += in.x, book.gravity[1] += in.y;
  for (int k : {0, 1}) book.friction[k] += friction[k], book.cutoff[k] += portion * s.cutoff[k];
  // What a corner on a side got from inside went out; what it gives back comes in with the other half step.
  if (on_side(i, j)) {
    book_side(i, j, -(in_hu + in.x + friction[0] + portion * s.cutoff[0]), -(in_hv + in.y + friction[1] + portion * s.cutoff[1]),
              book);
  }
  sums.note(got.sum.h, s.hu, s.hv);
}

double NocSolver::Impl::share_to_centre(int i, int j, int a, int b) const {
  const double cx = a == 0 ? 1 : -1, cy = b == 0 ? 1 : -1;
  const int n = corners.at(i + a, j + b);
  // A locked corner gives back what it got.
  return corners.locked[n] ? share_depth(centres.points[centres.at(i, j)], -cx, -cy) : share_depth(corners.points[n], cx, cy);
}

NocSolver::Impl::Gathered NocSolver::Impl::gather_centre(int i, int j, double tau) const {
  Gathered got;
  for (int a : {0, 1}) {
    for (int b : {0, 1}) {
      const double cx = a == 0 ? 1 : -1, cy = b == 0 ? 1 : -1;
      const int n = corners.at(i + a, j + b);
      const Point& p = corners.points[n];
      got.share[a][b] = share(p, cx, cy);
      got.share[a][b].h = share_to_centre(i, j, a, b);
      got.push[a][b] = push(p, terrain, 2 * i + a, 2 * j + b, cx, cy, settings.closure.tan_delta, settings.dry_depth, tau);
      got.reach = std::max(got.reach, p.reach);
      got.held = got.held && corners.locked[n];
    }
  }
  got.add_up();
  if (got.held) got.sum.h = centres.q.h[centres.at(i, j)];
  return got;
}

void NocSolver::Impl::update_centre(int i, int j, double tau, RowSums& sums) {
  const Gathered got = gather_centre(i, j, tau);
  const Settled s = settle(got);
  const int c = centres.at(i, j);
  centres.q.h[c] = got.sum.h, centres.q.hu[c] = s.hu, centres.q.hv[c] = s.hv;

  Budget& book = sums.budget;
  for (int a : {0, 1}) {
    for (int b : {0, 1}) {
      if (on_side(i + a, j + b)) book_side(i + a, j + b, got.share[a][b].hu, got.share[a][b].hv, book);
    }
  }
  book.gravity[0] += got.all.x, book.gravity[1] += got.all.y;
  for (int k : {0, 1}) book.friction[k] += s.friction[k], book.cutoff[k] += s.cutoff[k];
  sums.note(got.sum.h, s.hu, s.hv);
}

}  // namespace couloir
