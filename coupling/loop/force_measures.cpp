#include "coupling/loop/force_measures.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"

namespace couloir {
namespace {

constexpr int margin = 2;  // cells between an obstacle's base and its control volume's faces

// The cells that the base's bounding box touches, and `more` on each side, inside the grid.
CellBox cells_around(const ObstacleSpec& o, const Grid& g, int more) {
  const auto low = [&](double edge, double origin, double step) {
    return static_cast<int>(std::floor((edge - origin) / step + 1e-6));
  };
  const auto high = [&](double edge, double origin, double step) {
    return static_cast<int>(std::ceil((edge - origin) / step - 1e-6));
  };
  return {std::max(0, low(o.x, g.x0, g.dx) - more), std::min(g.nx, high(o.x + o.length, g.x0, g.dx) + more),
          std::max(0, low(o.y - o.width / 2, g.y0, g.dy) - more), std::min(g.ny, high(o.y + o.width / 2, g.y0, g.dy) + more)};
}

bool meet(const CellBox& a, const CellBox& b) {
  return !a.empty() && !b.empty() && a.i0 < b.i1 && b.i0 < a.i1 && a.j0 < b.j1 && b.j0 < a.j1;
}

// An obstacle pushes up to two cells beside its base, too.
bool alone(const Scene& scene, std::size_t n, const CellBox& box, const Grid& g) {
  for (std::size_t m = 0; m < scene.obstacles.size(); ++m) {
    if (m != n && meet(box, cells_around(scene.obstacles[m], g, 2))) return false;
  }
  return true;
}

bool meets_any(const CellBox& box, const std::vector<CellBox>& zones) {
  return std::ranges::any_of(zones, [&](const CellBox& zone) { return meet(box, zone); });
}

}  // namespace

std::vector<ForceMeasure> wall_measures(const Scene& scene) {
  std::vector<ForceMeasure> list;
  for (int side = 0; side < 4; ++side) {
    if (scene.sides[side].kind == SideSpec::Kind::wall) list.push_back({side_names[side], "wall"});
  }
  return list;
}

ForceMeasures::ForceMeasures(const Scene& scene, const ReferenceSurface& surface, FlowModel& solver,
                             const std::vector<CellBox>& zones)
    : density_(scene.material.density) {
  for (std::size_t n = 0; n < scene.obstacles.size(); ++n) {
    const CellBox box = cells_around(scene.obstacles[n], solver.grid(), margin);
    if (meets_any(box, zones) || !alone(scene, n, box, solver.grid())) continue;
    const int id = solver.add_control_box(box);
    list_.push_back({scene.obstacles[n].name, "control_volume"});
    boxes_.push_back({id});
  }
  add_elevation(scene, surface, solver, zones);
  for (const ForceMeasure& wall : wall_measures(scene)) {
    list_.push_back(wall);
    walls_.push_back(static_cast<int>(std::ranges::find(side_names, wall.of) - side_names.begin()));
  }
}

// The slopes are means over each cell, so that their sum over a face is its height wherever the cells' edges lie.
void ForceMeasures::add_elevation(const Scene& scene, const ReferenceSurface& surface, const FlowModel& solver,
                                  const std::vector<CellBox>& zones) {
  const Grid& g = solver.grid();
  const Elevation smooth = elevation(scene);
  for (const ElevationBody& body : smooth.bodies()) {
    const CellBox box = cells_around(scene.obstacles[body.obstacle()], g, 1);
    if (meets_any(box, zones)) continue;
    Sum all, front;
    for (int j = box.j0; j < box.j1; ++j) {
      for (int i = box.i0; i < box.i1; ++i) {
        const double x = g.x(i), y = g.y(j);
        const double rise_x = body.at(x + g.dx / 2, y) - body.at(x - g.dx / 2, y);
        const double rise_y = body.at(x, y + g.dy / 2) - body.at(x, y - g.dy / 2);
        if (rise_x == 0 && rise_y == 0) continue;
        const double weight = density_ * scene.gravity * std::cos(surface.angle(x));
        all.cells.push_back({i, j, weight * rise_x * g.dy, weight * rise_y * g.dx});
        if (rise_x > 0) front.cells.push_back(all.cells.back());
      }
    }
    for (Sum* sum : {&all, &front}) {
      sum->before = sum->now(solver);
      list_.push_back({body.name(), sum == &all ? "elevation" : "elevation_upstream"});
      sums_.push_back(std::move(*sum));
    }
  }
}

std::array<double, 2> ForceMeasures::Sum::now(const FlowModel& solver) const {
  std::array<double, 2> sum{};
  for (const Cell& c : cells) {
    const double h = solver.at(c.i, c.j).h;
    sum[0] += c.x * h, sum[1] += c.y * h;
  }
  return sum;
}

std::vector<std::array<double, 2>> ForceMeasures::read(const FlowModel& solver, double window) {
  std::vector<std::array<double, 2>> out;
  for (Box& box : boxes_) {
    const auto now = solver.control_box_impulse(box.id);
    out.push_back({density_ * (now[0] - box.before[0]) / window, density_ * (now[1] - box.before[1]) / window});
    box.before = now;
  }
  for (Sum& sum : sums_) {
    const auto now = sum.now(solver);
    out.push_back({0.5 * (sum.before[0] + now[0]), 0.5 * (sum.before[1] + now[1])});
    sum.before = now;
  }
  for (int side : walls_) {
    const auto& to_flow = solver.budget().sides[side];
    out.push_back({-density_ * to_flow[0] / window, -density_ * to_flow[1] / window});
  }
  return out;
}

}  // namespace couloir
