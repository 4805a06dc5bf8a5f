#include "coupling/plan/zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/plan/flow_estimate.hpp"
#include "coupling/plan/validity.hpp"
#include "coupling/scene/release_shape.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

struct Reach {
  double before, beside, behind;
};

Reach reach_of(const ObstacleSpec& o, double d, const FlowEstimate& flow) {
  const double run_up = (flow.froude < 2 ? 15 : 10) * flow.depth;
  return {std::max({2 * o.height, 30 * d, run_up}), std::max({0.3 * o.height, 8 * d, 4 * flow.depth}),
          std::max(0.25 * o.height, 5 * d)};
}

PlannedZone on_cells(const CellBox& cells, const Grid& grid, std::string reason) {
  return {box_of(cells, grid), cells, std::move(reason), {}};
}

// The cells that a box touches.
CellBox cells_around(const ZoneBox& box, const Grid& grid) {
  const auto low = [](double edge, double origin, double step) {
    return static_cast<int>(std::floor((edge - origin) / step + 1e-6));
  };
  const auto high = [](double edge, double origin, double step) {
    return static_cast<int>(std::ceil((edge - origin) / step - 1e-6));
  };
  return {std::max(0, low(box.x0, grid.x0, grid.dx)), std::min(grid.nx, high(box.x1, grid.x0, grid.dx)),
          std::max(0, low(box.y0, grid.y0, grid.dy)), std::min(grid.ny, high(box.y1, grid.y0, grid.dy))};
}

PlannedZone around(const Scene& scene, const std::vector<ObstacleSpec>& obstacles) {
  const double d = scene.grains.diameter, length = scene.terrain.total_length(), half = scene.terrain.width / 2;
  ZoneBox box{length, 0, half, -half};
  std::string reason;
  double first_obstacle = length;
  for (const ObstacleSpec& o : obstacles) {
    const FlowEstimate flow = flow_estimate_at(scene, o.x);
    const Reach reach = reach_of(o, d, flow);
    first_obstacle = std::min(first_obstacle, o.x);
    box.x0 = std::min(box.x0, o.x - reach.before);
    box.x1 = std::max(box.x1, o.x + o.length + reach.behind);
    box.y0 = std::min(box.y0, o.y - o.width / 2 - reach.beside);
    box.y1 = std::max(box.y1, o.y + o.width / 2 + reach.beside);
    reason += fmt::format(
        "{}{} is {} high, the flow expected there {} deep at {:.3g} m/s (Fr {:.3g}), the grains {}: {} before it, {} beside, "
        "{} behind",
        reason.empty() ? "" : "; ", o.name, len(o.height), fmt::format("{:.3g} mm", flow.depth * 1e3), flow.velocity, flow.froude,
        len(d), len(reach.before), len(reach.beside), len(reach.behind));
  }
  if (scene.release.kind != ReleaseSpec::Kind::uniform) {
    const double front = release_footprint(scene).x1;
    const double latest = first_obstacle - 10 * d;
    if (box.x0 < front && front < latest) {
      box.x0 = std::ceil(front / grid_of(scene).dx - 1e-6) * grid_of(scene).dx;
      reason += fmt::format("; it starts at the release's lower edge, {}", len(front));
    }
  }
  box.x0 = std::max(box.x0, 4 * d);  // room for the driven layer
  if (box.x1 > length - 6 * d) box.x1 = length;
  // Both or none, so that a symmetric scene keeps a symmetric zone; periodic sides are one line.
  const bool low = box.y0<-half + 6 * d, high = box.y1> half - 6 * d;
  const bool periodic = scene.sides[2].kind == SideSpec::Kind::periodic;
  if (low || (periodic && high)) box.y0 = -half;
  if (high || (periodic && low)) box.y1 = half;
  const Grid grid = grid_of(scene);
  return on_cells(cells_around(box, grid), grid, "automatic: " + reason);
}

// Whether the layers and buffers of two zones would meet.
bool too_near(const ZoneBox& a, const ZoneBox& b, const Scene& scene) {
  const double gap = 40 * scene.grains.diameter;
  if (scene.sides[2].kind == SideSpec::Kind::periodic) return a.x0 - gap < b.x1 && b.x0 < a.x1 + gap;  // both ways round
  return a.x0 - gap < b.x1 && b.x0 < a.x1 + gap && a.y0 - gap < b.y1 && b.y0 < a.y1 + gap;
}

// Those at which the shallow model fails; where it holds everywhere, all.
std::vector<ObstacleSpec> obstacles_for_grains(const Scene& scene) {
  std::vector<ObstacleSpec> out;
  for (const ObstacleSpec& o : scene.obstacles)
    if (!shallow_verdict(scene, o).holds()) out.push_back(o);
  return out.empty() ? scene.obstacles : out;
}

// Obstacles whose zones would be too near to each other share one.
std::vector<PlannedZone> automatic(const Scene& scene) {
  if (scene.obstacles.empty()) {
    throw SceneError(
        "grains.zone is auto, but there is no obstacle to put it around; give a box {x: [.., ..], y: [.., ..]} or an obstacle");
  }
  std::vector<std::vector<ObstacleSpec>> groups;
  std::vector<PlannedZone> zones;
  for (const ObstacleSpec& o : obstacles_for_grains(scene)) {
    groups.push_back({o});
    zones.push_back(around(scene, groups.back()));
  }
  for (std::size_t a = 0; a < zones.size();) {
    std::size_t b = a + 1;
    while (b < zones.size() && !too_near(zones[a].box, zones[b].box, scene)) ++b;
    if (b == zones.size()) {
      ++a;
      continue;
    }
    groups[a].insert(groups[a].end(), groups[b].begin(), groups[b].end());
    groups.erase(groups.begin() + long(b));
    zones.erase(zones.begin() + long(b));
    zones[a] = around(scene, groups[a]);
    a = 0;  // what is larger now may be near to others
  }
  return zones;
}

PlannedZone all_but_inflows(const Scene& scene) {
  const Grid grid = grid_of(scene);
  const auto strip = [&](int side, double step) {
    const int room = static_cast<int>(std::ceil(4 * scene.grains.diameter / step - 1e-9));
    return scene.sides[static_cast<std::size_t>(side)].kind == SideSpec::Kind::inflow ? std::max(4, room) : 0;
  };
  const CellBox cells{strip(0, grid.dx), grid.nx - strip(1, grid.dx), strip(2, grid.dy), grid.ny - strip(3, grid.dy)};
  if (cells.empty()) {
    throw SceneError(
        fmt::format("{}: continuum.cell is {}: the strips of four cells in which an inflow comes to the grains fill the domain; "
                    "use smaller cells",
                    scene.places.of("continuum.cell"), len(grid.dx)));
  }
  PlannedZone zone = on_cells(
      cells, grid, "mode is grains: all but the strip in which the inflow, a shallow flow of four cells or more, comes in");
  zone.lines = {{cells.i0, cells.i1}, {cells.j0, cells.j1}, 0, 0};
  return zone;
}

}  // namespace

std::vector<PlannedZone> planned_zones(const Scene& scene) {
  if (feeds_grains_alone(scene)) return {all_but_inflows(scene)};
  const Grid grid = grid_of(scene);
  std::vector<PlannedZone> zones;
  for (const ZoneBox& box : scene.grains.zones)
    zones.push_back(on_cells(cells_in(box, grid), grid, "given by the scene, moved to the nearest cell lines"));
  if (zones.empty()) zones = automatic(scene);
  for (std::size_t n = 0; n < zones.size(); ++n) {
    std::vector<CellBox> others;
    for (std::size_t m = 0; m < zones.size(); ++m) {
      const ZoneLines& l = zones[m].lines;
      if (m < n) others.push_back({l.x.front(), l.x.back(), l.y.front(), l.y.back()});
      if (m > n) others.push_back(zones[m].cells);
    }
    zones[n].lines = growth_lines(scene, zones[n].cells, others);
  }
  return zones;
}

}  // namespace couloir
