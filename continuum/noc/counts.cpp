// What passed in a step: through the open sides, through gauges, onto obstacles. Taken from the shares of both half steps, before
// the centres change.

#include <algorithm>
#include <array>
#include <vector>

#include "continuum/noc/noc_impl.hpp"

namespace couloir {

double NocSolver::Impl::gain(int i, int j, int a, int b) const {
  const Point giver = centres.point(centres.at(i, j));
  return share_to_centre(i, j, a, b) - noc::share_depth(giver, a == 0 ? -1 : 1, b == 0 ? -1 : 1);
}

// A corner on the side has cells on one hand only: what they get from it and did not give to it came in. Where an inflow meets
// an outflow it is the inflow's. Periodic twins have the cells of either end.
void NocSolver::Impl::count_sides() {
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
  for (int j = near_corners.j0(); j < near_corners.j1(); ++j) {
    const bool whole_row = j == 0 || j == g.ny;
    for (int i = near_corners.begin(j); i < near_corners.end(j); ++i) {
      if ((whole_row || i == 0 || i == g.nx) && on_open_side(i, j)) count(i, j);
    }
  }
  budget.mass_boundary += g.dx * g.dy * through;
  budget.mass_inflow += g.dx * g.dy * through_inflow;
}

// The exchange of a corner across the gauge's line: half of what the cells beyond gain less what those before it do. On the
// domain's side only one of them is there. Gauges side by side add up.
void NocSolver::Impl::count_gauges() {
  const Grid& g = settings.grid;
  for (Gauge& gauge : gauges) {
    const bool before = gauge.i > 0, beyond = gauge.i < g.nx;
    double sum = 0;
    for (int j = gauge.j0; j < gauge.j1; ++j) {
      if (!near_corners.contains(gauge.i, j) || !near_corners.contains(gauge.i, j + 1)) continue;
      for (int b : {0, 1}) {
        const double in = beyond ? gain(gauge.i, j, 0, b) : 0.0, out = before ? gain(gauge.i - 1, j, 1, b) : 0.0;
        sum += before && beyond ? 0.5 * (in - out) : in - out;
      }
    }
    gauge.volume += g.dx * g.dy * sum;
  }
}

// The sources count the push of the whole bed; the obstacles' part of it is theirs, on every quadrant that a receiver gets. Of a
// nested grid's patch only a part of them counts for the impulse.
void NocSolver::Impl::count_obstacles(const Lattice& givers, const Region& receivers, double tau) {
  using Push = std::array<double, 2>;
  const double part = 0.25 * tau * settings.grid.dx * settings.grid.dy;
  const int shift = &givers == &corners ? 1 : 0;  // quarter k belongs to centre k / 2 or corner (k + 1) / 2
  // Mirrored rows in pairs: the force across a symmetric body is 0.
  const auto total = [&](const std::vector<Push>& rows) {
    double x = 0, y = 0;
    for (std::size_t low = 0, high = rows.size() - 1; low < high; ++low, --high) {
      x += rows[low][0] + rows[high][0], y += rows[low][1] + rows[high][1];
    }
    return Push{x * part, y * part};
  };
  for (int id = 0; id < terrain.obstacles(); ++id) {
    const auto& quarters = terrain.obstacle(id);
    const bool some = !own_push.empty();
    std::vector<Push> all(terrain.quarters_y()), own(some ? all.size() : 0);
    for (std::size_t n = 0; n < quarters.size(); ++n) {
      const auto& q = quarters[n];
      const int i = (q.k + shift) / 2, j = (q.l + shift) / 2;
      if (!receivers.contains((q.k + 1 - shift) / 2, (q.l + 1 - shift) / 2)) continue;
      const double cx = givers.quarter(i) == q.k ? -1 : 1, cy = givers.quarter(j) == q.l ? -1 : 1;
      const double weight = terrain.weight(q.k) * noc::quarter_depth(givers.point(givers.at(i, j)), cx, cy);
      const Push push{weight * q.slope.x, weight * q.slope.y};
      all[q.l][0] += push[0], all[q.l][1] += push[1];
      if (some && own_push[id][n]) own[q.l][0] += push[0], own[q.l][1] += push[1];
    }
    const Push whole = total(all), counted = some ? total(own) : whole;
    for (int k : {0, 1}) impulse[id][k] += counted[k], budget.obstacles[k] -= whole[k], budget.gravity[k] += whole[k];
  }
}

void NocSolver::Impl::count_forces_in(const CellBox& cells, const std::vector<CellBox>& others) {
  own_push.assign(terrain.obstacles(), {});
  for (int id = 0; id < terrain.obstacles(); ++id) {
    for (const auto& q : terrain.obstacle(id)) {
      const auto holds = [&](const CellBox& b) { return b.contains(q.k / 2, q.l / 2); };
      own_push[id].push_back(holds(cells) && std::none_of(others.begin(), others.end(), holds));
    }
  }
}

// What the change of the states brings into the boxes is taken as there before, so that no body seems to have given it.
void NocSolver::Impl::replace(const CellBox& cells, const std::function<FlowState(int i, int j)>& state) {
  const double area = settings.grid.dx * settings.grid.dy;
  const auto inside = [&](const CellBox& b) {
    return CellBox{std::max(b.i0, cells.i0), std::min(b.i1, cells.i1), std::max(b.j0, cells.j0), std::min(b.j1, cells.j1)};
  };
  const auto note_boxes = [&](double sign) {
    for (noc::ControlBox& box : boxes) {
      const CellBox both = inside(box.cells);
      if (both.empty()) continue;
      const auto held = momentum_in(both);
      for (int k : {0, 1}) box.before[k] += sign * held[k];
    }
  };
  note_boxes(-1);
  std::vector<std::array<double, 3>> rows(cells.j1 - cells.j0);
  for (int j = cells.j0; j < cells.j1; ++j) {
    std::array<double, 3>& row = rows[j - cells.j0];
    for (int i = cells.i0; i < cells.i1; ++i) {
      const FlowState before = get(i, j);
      put(i, j, state(i, j));
      const FlowState now = get(i, j);
      row[0] += now.h - before.h, row[1] += now.hu - before.hu, row[2] += now.hv - before.hv;
    }
  }
  note_boxes(+1);
  double sum[3] = {};
  for (std::size_t low = 0, high = rows.size(); low < high; ++low) {
    --high;
    for (int n = 0; n < 3; ++n) sum[n] += low == high ? rows[low][n] : rows[low][n] + rows[high][n];
  }
  budget.mass_copied += area * sum[0];
  for (int k : {0, 1}) budget.copied[k] += area * sum[k + 1];
}

}  // namespace couloir
