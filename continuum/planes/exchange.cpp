// The planes model's step: edges, slope, planes.

#include <algorithm>
#include <limits>

#include "continuum/planes/planes_impl.hpp"

namespace couloir {
namespace {

// Shares of a cell's content that may cross one edge in a step. The slope's own solver allows half; a corner cell of a plane has
// two edges, and the step two stages.
constexpr double slope_share = 0.45, plane_share = 0.24;

bool along_x(SideName side) {
  return PlaneFlow::is_a(side);
}

// Towards the edge is along +axis (1) or against it (-1). The slope lies outside of the rim, a plane inside of its own sides.
double direction(const PlaneSide& s) {
  return is_low(s.side) == (s.plane == PlaneName::slope) ? 1 : -1;
}

// The axes (0, 1, 2: x, y, z) across and along the edge.
int axis_across(const PlaneSide& s) {
  const PlaneAxes axes = axes_of(s.plane);
  return PlaneFlow::is_a(s.side) ? axes.a : axes.b;
}
int axis_along(const PlaneSide& s) {
  const PlaneAxes axes = axes_of(s.plane);
  return PlaneFlow::is_a(s.side) ? axes.b : axes.a;
}

}  // namespace

CellBox PlanesModel::Impl::slope_cell(SideName side, int k) const {
  const int i = side == SideName::upstream ? box.i0 - 1 : side == SideName::downstream ? box.i1 : box.i0 + k;
  const int j = side == SideName::left ? box.j0 - 1 : side == SideName::right ? box.j1 : box.j0 + k;
  return {i, i + 1, j, j + 1};
}

EdgeCell PlanesModel::Impl::cell(const PlaneSide& s, int k) const {
  if (s.plane != PlaneName::slope) return plane(s.plane).edge_cell(s.side, k);
  const CellBox c = slope_cell(s.side, k);
  const FlowState q = slope.at(c.i0, c.j0);
  if (q.h < dry_depth) return {};
  const bool x = along_x(s.side);
  const double pressure = slope.earth_pressure(c.i0, c.j0)[x ? 0 : 1];
  return {q.h, direction(s) * (x ? q.hu : q.hv) / q.h, (x ? q.hv : q.hu) / q.h,
          pressure * rim_weight[static_cast<int>(s.side)][k]};
}

double PlanesModel::Impl::most(const PlaneSide& s, int k, double dt) const {
  if (s.plane != PlaneName::slope) return plane_share * plane(s.plane).content(s.side, k) / dt;
  const CellBox c = slope_cell(s.side, k);
  return slope_share * slope.at(c.i0, c.j0).h * (along_x(s.side) ? cells.dx : cells.dy) / dt;
}

void PlanesModel::Impl::impose(const PlaneSide& s, int k, double mass_out, double along_out, double normal) {
  const double sign = direction(s), mass = sign * mass_out, along = sign * along_out;
  const FaceFlux f = along_x(s.side) ? FaceFlux{mass, normal, along} : FaceFlux{mass, along, normal};
  if (s.plane == PlaneName::slope) {
    slope.impose(hole, s.side, k, f);
  } else {
    plane(s.plane).impose(s.side, k, f);
  }
}

void PlanesModel::Impl::refresh() {
  if (fresh) return;
  timer.apart(StepPart::planes, [&] {
    for (PlaneFlow& p : planes) p.refresh();
  });
  fresh = true;
}

double PlanesModel::Impl::stable_dt() {
  refresh();
  double dt = slope.stable_dt();
  for (const PlaneFlow& p : planes) dt = std::min(dt, p.stable_dt());
  return dt;
}

void PlanesModel::Impl::step(double dt) {
  dt = std::min(dt, stable_dt());
  timer.apart(StepPart::planes, [&] { find_fluxes(dt); });
  slope.reset_rim(hole);
  const double start = slope.time(), front_before = plane(PlaneName::front).volume();
  slope.step(dt);
  dt = slope.time() - start;  // a step that would overdraw a cell of the slope was shorter
  timer.apart(StepPart::planes, [&] {
    take_passed(dt);
    book_edges(dt);
    for (PlaneFlow& p : planes) p.step(dt);
    book_planes(dt, 0.5 * (front_before + plane(PlaneName::front).volume()));
  });
  time += dt;
  fresh = false;
}

void PlanesModel::Impl::find_fluxes(double dt) {
  using Kind = PlaneEdge::Kind;
  shed = {};
  for (std::size_t n = 0; n < edges.size(); ++n) {
    const PlaneEdge& e = edges[n];
    for (int k = 0; k < e.faces; ++k) {
      const EdgeCell one = cell(e.one, k);
      EdgeFlux& f = flux[n][k];
      if (e.kind == Kind::shed) {
        f = free_edge(one, most(e.one, k, dt));
        Shed& below = shed[static_cast<int>(e.two.side)];
        below.mass += f.mass * e.length / cells.dx;
        below.along += f.normal_1 * e.length / cells.dx;
      } else if (e.two.plane == PlaneName::none) {
        f = {0, 0, wall_flux(one.h, one.toward, one.g), 0};
      } else {
        const EdgeCell two = cell(e.two, k);
        const double most_1 = most(e.one, k, dt), most_2 = most(e.two, k, dt);
        f = e.kind == Kind::concave ? concave_edge(one, two, eta, most_1, most_2) : convex_edge(one, two, most_1, most_2);
      }
    }
  }
  for (std::size_t n = 0; n < edges.size(); ++n) {
    const PlaneEdge& e = edges[n];
    for (int k = 0; k < e.faces; ++k) {
      const EdgeFlux& f = flux[n][k];
      const Shed& s = shed_at(e, k);
      impose(e.one, k, f.mass - s.mass, f.along - s.along, f.normal_1);
      if (e.kind == Kind::convex || e.kind == Kind::concave) impose(e.two, k, -f.mass, -f.along, f.normal_2);
    }
  }
}

const PlanesModel::Impl::Shed& PlanesModel::Impl::shed_at(const PlaneEdge& e, int k) const {
  static const Shed none;
  const bool below = e.kind == PlaneEdge::Kind::concave && !along_x(e.one.side) && k == e.faces - 1;
  return below ? shed[static_cast<int>(e.one.side)] : none;
}

// Only what the slope gives can have been less than asked for. What it gets stays as it was found: a difference of sums with what
// is shed there would, by its round-off, overdraw a plane that is all but empty.
void PlanesModel::Impl::take_passed(double dt) {
  for (std::size_t n = 0; n < edges.size(); ++n) {
    const PlaneEdge& e = edges[n];
    if (e.kind != PlaneEdge::Kind::concave) continue;
    for (int k = 0; k < e.faces; ++k) {
      EdgeFlux& f = flux[n][k];
      const double shed_mass = shed_at(e, k).mass, asked = f.mass - shed_mass;
      if (!(asked > 0)) continue;
      const double given = direction(e.one) * slope.passed(hole, e.one.side, k).mass / dt;
      const double of_slope = given / asked, of_plane = (given + shed_mass) / f.mass;
      f = {given + shed_mass, f.along * of_plane, f.normal_1 * of_slope, f.normal_2 * of_plane};
      impose(e.two, k, -f.mass, -f.along, f.normal_2);
    }
  }
}

// The slope's budget knows its own side of the rim. Here: the planes' sides, and what the foot takes from the slope.
void PlanesModel::Impl::book_edges(double dt) {
  for (std::size_t n = 0; n < edges.size(); ++n) {
    const PlaneEdge& e = edges[n];
    EdgeFlux all;
    for (const EdgeFlux& f : flux[n]) {
      all.along += f.along, all.normal_1 += f.normal_1, all.normal_2 += f.normal_2;
      if (e.two.plane == PlaneName::top) overflow += std::max(f.mass, 0.0) * dt * e.length;
    }
    const double share = dt * e.length;
    const auto enters = [&](const PlaneSide& s, double normal, double along) {
      if (s.plane == PlaneName::none || s.plane == PlaneName::slope) return;
      std::array<double, 2>& cause = e.kind == PlaneEdge::Kind::domain ? extra.boundary : extra.obstacles;
      const auto give = [&](int axis, double amount) {
        if (axis > 1) return;
        cause[axis] += amount;
        if (e.kind == PlaneEdge::Kind::domain) moved[axis] += amount;
      };
      give(axis_across(s), -direction(s) * share * normal);
      give(axis_along(s), share * along);
    };
    enters(e.one, all.normal_1, -all.along);
    enters(e.two, all.normal_2, all.along);
    if (e.kind == PlaneEdge::Kind::concave) impulse[axis_across(e.one)] += direction(e.one) * share * all.normal_1;
  }
}

void PlanesModel::Impl::book_planes(double dt, double front_volume) {
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const Budget b = planes[p].take_budget();
    const PlaneAxes axes = axes_of(static_cast<PlaneName>(p));
    const int axis[] = {axes.a, axes.b};
    for (int n : {0, 1}) {
      if (axis[n] > 1) continue;
      extra.gravity[axis[n]] += b.gravity[n];
      extra.obstacles[axis[n]] += b.friction[n];
      extra.cutoff[axis[n]] += b.cutoff[n];
      impulse[axis[n]] -= b.friction[n];
      moved[axis[n]] += b.gravity[n] + b.cutoff[n];
    }
    extra.mass_clipped += b.mass_clipped;
  }
  const double weight = dt * plane(PlaneName::front).weight() * front_volume;
  extra.gravity[0] += weight;
  extra.obstacles[0] -= weight;
  impulse[0] += weight;
  moved[0] += weight;
}

}  // namespace couloir
