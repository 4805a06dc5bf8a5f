// Sides through which material comes in.

#include <algorithm>
#include <cmath>

#include "continuum/flow/flux.hpp"
#include "continuum/noc/noc_impl.hpp"

namespace couloir {

using noc::Point;

namespace {

// An inflow that is slower than its waves stands at the side with its discharge at the critical depth (q^2/g)^(1/3): a deeper one
// would let in what its pressure drives, many times as much where the flow runs off.
InflowPoint at_least_critical(InflowPoint in, double g) {
  const double q = in.depth * in.velocity, critical = std::cbrt(q * q / g);
  if (in.depth > critical && q > 0) in.depth = critical, in.velocity = q / critical;
  return in;
}

}  // namespace

// What comes in at a time; an inflow that has run dry is a wall. False: as it was.
bool NocSolver::Impl::set_inflow(double at) {
  bool changed = false;
  for (int side = 0; side < 4; ++side) {
    if (sides[side].kind != Side::Kind::inflow) continue;
    const InflowPoint p = at_least_critical(inflow_at(sides[side], at), terrain.weight(side == 1 ? terrain.quarters_x() - 1 : 0));
    Side& s = settings.sides[side];
    const Side::Kind kind = p.depth > 0 ? Side::Kind::inflow : Side::Kind::wall;
    changed = changed || s.kind != kind || s.depth != p.depth || s.velocity != p.velocity;
    s.kind = kind, s.depth = p.depth, s.velocity = p.velocity;
  }
  if (changed) {
    lay_lines();
    wet_inflow();
    lay_regions();
  }
  return changed;
}

// Beyond an inflow stands what it is given, uniform and steady.
void NocSolver::Impl::make_inflow(double tau) {
  for (int side = 0; side < 4; ++side) {
    const Side& s = settings.sides[side];
    if (s.kind != Side::Kind::inflow) continue;
    const bool along_x = side < 2;
    const double inward = side % 2 == 0 ? s.velocity : -s.velocity, u = along_x ? inward : 0.0, v = along_x ? 0.0 : inward;
    const double weight = terrain.weight(side == 1 ? terrain.quarters_x() - 1 : 0);
    const EarthPressure& k = settings.closure.earth_pressure;
    const FaceFlux f = flux_x(s.depth, u, v, k.x_active * weight), g = flux_y(s.depth, u, v, k.y_active_active * weight);
    const double lx = 0.5 * tau / settings.grid.dx, ly = 0.5 * tau / settings.grid.dy;
    Point p;
    p.q = p.half = {s.depth, s.depth * u, s.depth * v};
    p.tilt_x = {lx * f.mass, lx * f.mom_x, lx * f.mom_y};
    p.tilt_y = {ly * g.mass, ly * g.mom_x, ly * g.mom_y};
    p.reach = s.velocity + 2 * std::sqrt(std::max(k.x_active, k.y_active_active) * weight * s.depth);
    const double keep = own_keep(p);
    for (FlowState* tilt : {&p.tilt_x, &p.tilt_y}) tilt->h *= keep, tilt->hu *= keep, tilt->hv *= keep;
    inflow[side] = p;
  }
}

// An inflow wets its side.
void NocSolver::Impl::wet_inflow() {
  const Grid& g = settings.grid;
  const CellBox edges[] = {{0, 1, 0, g.ny}, {g.nx - 1, g.nx, 0, g.ny}, {0, g.nx, 0, 1}, {0, g.nx, g.ny - 1, g.ny}};
  for (int side = 0; side < 4; ++side) {
    const Side& s = settings.sides[side];
    if (s.kind != Side::Kind::inflow || s.depth < settings.dry_depth) continue;
    for (int j = edges[side].j0; j < edges[side].j1; ++j) wet.add(j, edges[side].i0, edges[side].i1);
  }
}

// The staggered exchange across an inflow side lets in what its two states ask for: more than is stated wherever the flow speeds
// up behind the side. The cells along it are put right, the two cells at a corner by half of what it is off: material comes with
// the velocity of the inflow and leaves with that of the cell. What a cell has not got stays owed.
void NocSolver::Impl::put_inflow_right(double dt) {
  const Grid& g = settings.grid;
  for (const bool along_x : {true, false}) {
    const int low = along_x ? 0 : 2, high = low + 1, last = (along_x ? g.nx : g.ny) - 1;
    for (int k = 0; k < (along_x ? g.ny : g.nx); ++k) {
      const auto cell = [&](int n) { return along_x ? centres.at(n, k) : centres.at(k, n); };
      const FlowState below = inflow_change(low, k, cell(0), dt), above = inflow_change(high, k, cell(last), dt);
      if (last == 0) {  // both at once, so that no side comes first
        add_inflow(cell(0), {below.h + above.h, below.hu + above.hu, below.hv + above.hv});
      } else {
        add_inflow(cell(0), below), add_inflow(cell(last), above);
      }
    }
  }
}

// What cell k along a side has to get, and the books of it. At most half of a cell leaves at once, by all sides that
// share it: an empty one beside a full one would throw up what is left.
FlowState NocSolver::Impl::inflow_change(int side, int k, int cell, double dt) {
  const Side& s = settings.sides[side];
  if (s.kind != Side::Kind::inflow) return {};
  const bool along_x = side < 2, low = side % 2 == 0;
  std::vector<double>& owed = inflow_owed[side];
  const int n = static_cast<int>(owed.size());
  const auto entered = [&](int corner) { return (corner == 0 || corner == n ? 1.0 : 0.5) * inflow_entered[side][corner]; };
  owed[k] += dt * mean_discharge(sides[side], time, time + dt) / (along_x ? settings.grid.dx : settings.grid.dy) -
             (entered(k) + entered(k + 1));

  const noc::Three& q = centres.q;
  const int i = along_x ? (low ? 0 : settings.grid.nx - 1) : k, j = along_x ? k : (low ? 0 : settings.grid.ny - 1);
  FlowState change{std::max(owed[k], -0.5 * q.h[cell] / inflows_at(i, j)), 0, 0};
  owed[k] -= change.h;
  const double inward = low ? s.velocity : -s.velocity, leaving = change.h < 0 ? change.h / q.h[cell] : 0.0;
  change.hu = change.h < 0 ? leaving * q.hu[cell] : along_x ? change.h * inward : 0.0;
  change.hv = change.h < 0 ? leaving * q.hv[cell] : along_x ? 0.0 : change.h * inward;

  const double area = settings.grid.dx * settings.grid.dy;
  budget.mass_boundary += area * change.h;
  budget.mass_inflow += area * change.h;
  const std::array<double, 2> push{area * change.hu, area * change.hv};
  for (int axis : {0, 1}) budget.boundary[axis] += push[axis], budget.sides[side][axis] += push[axis];
  for (noc::ControlBox& box : boxes) {
    if (box.cells.contains(i, j)) box.terms.faces[0] += push[0], box.terms.faces[1] += push[1];
  }
  for (Gauge& gauge : gauges) {
    if (along_x && gauge.i == (low ? 0 : settings.grid.nx) && k >= gauge.j0 && k < gauge.j1)
      gauge.volume += (low ? area : -area) * change.h;
  }
  return change;
}

int NocSolver::Impl::inflows_at(int i, int j) const {
  const bool at[] = {i == 0, i == settings.grid.nx - 1, j == 0, j == settings.grid.ny - 1};
  int sum = 0;
  for (int side = 0; side < 4; ++side) sum += at[side] && settings.sides[side].kind == Side::Kind::inflow ? 1 : 0;
  return sum;
}

void NocSolver::Impl::add_inflow(int cell, const FlowState& change) {
  if (change.h == 0) return;
  const noc::Three& q = centres.q;
  q.h[cell] += change.h, q.hu[cell] += change.hu, q.hv[cell] += change.hv;
  if (q.h[cell] >= settings.dry_depth) return;
  const double area = settings.grid.dx * settings.grid.dy;
  budget.cutoff[0] -= area * q.hu[cell], budget.cutoff[1] -= area * q.hv[cell];
  q.hu[cell] = q.hv[cell] = 0;
}

}  // namespace couloir
