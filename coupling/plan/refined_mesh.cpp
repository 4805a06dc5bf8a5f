#include "coupling/plan/refined_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/mesh/wishes.hpp"
#include "continuum/noc/nested/layout.hpp"
#include "continuum/noc/nested/nest.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/scene/refine.hpp"

namespace couloir {
namespace {

std::vector<LevelCells> count_patches(const SolverSettings& s, bool periodic_x, bool periodic_y) {
  std::vector<LevelCells> count;
  for (int level = 0; level <= s.refinement.levels(); ++level) count.push_back({level, s.grid.refined(level).dx, 0, 0});
  count[0].blocks = 1, count[0].cells = std::int64_t{s.grid.nx} * s.grid.ny;
  for (const noc::PatchPlace& p : noc::lay_patches(s.grid, s.refinement, periodic_x, periodic_y, noc::rim_width(s.limiter) / 2)) {
    ++count[p.level].blocks;
    count[p.level].cells += 4 * std::int64_t{p.foot.i1 - p.foot.i0} * (p.foot.j1 - p.foot.j0);
  }
  return count;
}

}  // namespace

std::vector<LevelCells> planned_levels(const Scene& scene) {
  if (scene.mode == Mode::grains || !scene.continuum.refined()) return {};
  const SolverSettings s = solver_settings(scene);
  const bool periodic_x = s.sides[0].kind == Side::Kind::periodic, periodic_y = s.sides[2].kind == Side::Kind::periodic;
  return scene.continuum.scheme == "noc" ? count_patches(s, periodic_x, periodic_y)
                                         : count_levels(s.grid, s.block, periodic_x, periodic_y, s.refinement.boxes);
}

double cells_by_work(const Scene& scene) {
  const Grid g = grid_of(scene);
  const double wet = wet_area(scene) / (g.dx * g.dy);
  double work = std::min(wet, static_cast<double>(g.nx) * g.ny);
  for (const LevelCells& l : planned_levels(scene)) {
    if (l.level > 0) work += std::ldexp(static_cast<double>(l.cells), l.level);
  }
  const double followed = std::min(followed_area(scene), wet_area(scene)) / (g.dx * g.dy);  // dry cells cost nothing
  return work + followed * (std::ldexp(1.0, 3 * scene.continuum.adapt.levels) - 1);
}

}  // namespace couloir
