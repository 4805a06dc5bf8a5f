#include "coupling/scene/refine.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/scene/release_shape.hpp"

namespace couloir {

RefineRectangle refine_rectangle(const Scene& scene, const RefineSpec& r) {
  if (r.around.empty()) return {r.x0, r.x1, r.y0, r.y1};
  const ObstacleSpec& o = *std::ranges::find(scene.obstacles, r.around, &ObstacleSpec::name);
  const double edge = r.from == RefineSpec::From::front ? o.x : o.x + o.length;
  return {o.x - r.up, edge + r.down, o.y - o.width / 2 - r.left, o.y + o.width / 2 + r.right};
}

RefineRectangle within_domain(const Scene& scene, const RefineRectangle& r) {
  const double length = scene.terrain.total_length(), half = scene.terrain.width / 2;
  return {std::max(r.x0, 0.0), std::min(r.x1, length), std::max(r.y0, -half), std::min(r.y1, half)};
}

int block_edge(const Scene& scene) {
  const ContinuumSpec& c = scene.continuum;
  if (c.block > 0) return c.block;
  if (!c.refined()) return 32;
  int levels = c.adapt.levels;
  for (const RefineSpec& r : c.refine) levels = std::max(levels, r.levels);
  return std::max(16, 1 << levels);
}

double wet_area(const Scene& scene) {
  const double all = scene.terrain.total_length() * scene.terrain.width;
  if (scene.release.kind == ReleaseSpec::Kind::uniform || scene.fed()) return all;
  const Footprint f = release_footprint(scene);
  return std::min(all, 6 * (f.x1 - f.x0) * (f.y1 - f.y0));
}

double followed_area(const Scene& scene) {
  const AdaptSpec& a = scene.continuum.adapt;
  if (a.levels == 0) return 0;
  // In coarsest cells: the blocks that are cut for the finest ones, and as far as the solver looks ahead on both sides.
  const auto width = [&](int edge, int interval) { return std::ldexp(edge, 1 - a.levels) + interval + 2; };
  const double wider = width(block_edge(scene), a.interval) / width(std::max(16, 1 << a.levels), AdaptSpec().interval);
  return std::min(0.1 * wider * wet_area(scene), scene.terrain.total_length() * scene.terrain.width);
}

double estimated_cells(const Scene& scene) {
  const ContinuumSpec& c = scene.continuum;
  const double length = scene.terrain.total_length(), width = scene.terrain.width;
  const double cell = c.cell * c.across(), domain = length * width;
  double cells = domain / cell;
  const bool blocks = c.scheme != "noc";
  for (const RefineSpec& r : c.refine) {
    const RefineRectangle box = within_domain(scene, refine_rectangle(scene, r));
    for (int level = 1; level <= r.levels; ++level) {
      // Whole blocks of the level before are cut into four; on the mean one more along each direction than the rectangle has.
      const double more = 2 * r.margin * (r.levels - level), part = std::ldexp(block_edge(scene), 1 - level);
      const double nx = box.x1 - box.x0 + more + (blocks ? part * c.cell : 0),
                   ny = box.y1 - box.y0 + more + (blocks ? part * c.across() : 0);
      const double area = std::min(nx, length) * std::min(ny, width);
      cells += 0.75 * area / cell * std::ldexp(1, 2 * level);
    }
  }
  return cells + followed_area(scene) / cell * (std::ldexp(1, 2 * c.adapt.levels) - 1);
}

}  // namespace couloir
