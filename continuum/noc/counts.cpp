// What passed in a step: through the open sides, through gauges, onto obstacles. Taken from the shares of both half steps, before
// the centres change.

#include <algorithm>
#include <array>
#include <vector>

#include "continuum/noc/noc_impl.hpp"

namespace couloir {

double NocSolver::Impl::gain(int i, int j, int a, int b) const {
  const noc::Point& giver = centres.points[centres.at(i, j)];
  return share_to_centre(i, j, a, b) - noc::share_depth(giver, a == 0 ? -1 : 1, b == 0 ? -1 : 1);
}

// A corner on the side has cells on one hand only: what they get from it and did not give to it came in. Where an inflow meets
// an outflow it is the inflow's. Periodic twins have the cells of either end.
void NocSolver::Impl::count_sides(const CellBox& box) {
  const Grid& g = settings.grid;
  double through = 0, through_inflow = 0;
  for (std::vector<double>& side : inflow_entered) std::fill(side.begin(), side.end(), 0.0);
  const auto inflow_side = [&](int i, int j) {
    const bool at[] = {i == 0, i == g.nx, j == 0, j == g.ny};
    for (int side = 0; side < 4; ++side) {
      if (at[side] && settings.sides[side].kind == Side::Kind::inflow) return side;
    }
    return -1;
  };
  const auto count = [&](int i, int j) {
    double sum = 0;
    for (int a : {0, 1}) {
      for (int b : {0, 1}) {  // the cell of which the corner is the upper (1) or lower (0) one
        const int ci = i - a, cj = j - b;
        if (ci >= 0 && cj >= 0 && ci < g.nx && cj < g.ny) sum += gain(ci, cj, a, b);
      }
    }
    through += sum;
    if (const int side = inflow_side(i, j); side >= 0) {
      through_inflow += sum;
      inflow_entered[side][side < 2 ? j : i] = sum;
    }
  };
  for (int j = box.j0; j < box.j1; ++j) {
    const bool whole_row = j == 0 || j == g.ny;
    for (int i = box.i0; i < box.i1; ++i) {
      if ((whole_row || i == 0 || i == g.nx) && on_open_side(i, j)) count(i, j);
    }
  }
  budget.mass_boundary += g.dx * g.dy * through;
  budget.mass_inflow += g.dx * g.dy * through_inflow;
}

// The exchange of a corner across the gauge's line: half of what the cells beyond gain less what those before it do. On the
// domain's side only one of them is there. Gauges side by side add up.
void NocSolver::Impl::count_gauges(const CellBox& box) {
  const Grid& g = settings.grid;
  for (Gauge& gauge : gauges) {
    if (gauge.i < box.i0 || gauge.i >= box.i1) continue;
    const bool before = gauge.i > 0, beyond = gauge.i < g.nx;
    double sum = 0;
    for (int j = std::max(gauge.j0, box.j0); j < std::min(gauge.j1, box.j1 - 1); ++j) {
      for (int b : {0, 1}) {
        const double in = beyond ? gain(gauge.i, j, 0, b) : 0.0, out = before ? gain(gauge.i - 1, j, 1, b) : 0.0;
        sum += before && beyond ? 0.5 * (in - out) : in - out;
      }
    }
    gauge.volume += g.dx * g.dy * sum;
  }
}

// The sources count the push of the whole bed; the obstacles' part of it is theirs, on every quadrant that a receiver gets.
void NocSolver::Impl::count_obstacles(const Lattice& givers, const CellBox& receivers, double tau) {
  const double part = 0.25 * tau * settings.grid.dx * settings.grid.dy;
  const int shift = &givers == &corners ? 1 : 0;  // quarter k belongs to centre k / 2 or corner (k + 1) / 2
  for (int id = 0; id < terrain.obstacles(); ++id) {
    std::vector<std::array<double, 2>> rows(terrain.quarters_y());
    for (const auto& q : terrain.obstacle(id)) {
      const int i = (q.k + shift) / 2, j = (q.l + shift) / 2;
      if (!receivers.contains((q.k + 1 - shift) / 2, (q.l + 1 - shift) / 2)) continue;
      const double cx = givers.quarter(i) == q.k ? -1 : 1, cy = givers.quarter(j) == q.l ? -1 : 1;
      const double weight = terrain.weight(q.k) * noc::quarter_depth(givers.points[givers.at(i, j)], cx, cy);
      rows[q.l][0] += weight * q.slope.x, rows[q.l][1] += weight * q.slope.y;
    }
    // Mirrored rows in pairs: the force across a symmetric body is 0.
    double x = 0, y = 0;
    for (std::size_t low = 0, high = rows.size() - 1; low < high; ++low, --high) {
      x += rows[low][0] + rows[high][0], y += rows[low][1] + rows[high][1];
    }
    x *= part, y *= part;
    impulse[id][0] += x, impulse[id][1] += y;
    budget.obstacles[0] -= x, budget.obstacles[1] -= y;
    budget.gravity[0] += x, budget.gravity[1] += y;
  }
}

}  // namespace couloir
