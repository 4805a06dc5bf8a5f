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

std::vector<LevelCount> count_patches(const SolverSettings& s, bool periodic_x, bool periodic_y) {
  std::vector<LevelCount> count(s.refinement.levels() + 1);
  count[0] = {1, std::int64_t{s.grid.nx} * s.grid.ny};
  for (const noc::PatchPlace& p : noc::lay_patches(s.grid, s.refinement, periodic_x, periodic_y, noc::rim_width(s.limiter) / 2)) {
    ++count[p.level].blocks;
    count[p.level].cells += 4 * std::int64_t{p.foot.i1 - p.foot.i0} * (p.foot.j1 - p.foot.j0);
  }
  return count;
}

}  // namespace

std::vector<LevelCells> planned_levels(const Scene& scene) {
  std::vector<LevelCells> levels;
  if (scene.mode == Mode::grains || !scene.continuum.refined()) return levels;
  const SolverSettings s = solver_settings(scene);
  const bool periodic_x = s.sides[0].kind == Side::Kind::periodic, periodic_y = s.sides[2].kind == Side::Kind::periodic;
  const auto counts = scene.continuum.scheme == "noc" ? count_patches(s, periodic_x, periodic_y)
                                                      : count_levels(s.grid, s.block, periodic_x, periodic_y, s.refinement.boxes);
  for (std::size_t l = 0; l < counts.size(); ++l) {
    levels.push_back({static_cast<int>(l), std::ldexp(s.grid.dx, -static_cast<int>(l)), counts[l].blocks, counts[l].cells});
  }
  return levels;
}

double cells_by_work(const Scene& scene) {
  const Grid g = grid_of(scene);
  const double wet = wet_area(scene) / (g.dx * g.dy);
  double work = std::min(wet, static_cast<double>(g.nx) * g.ny);
  for (const LevelCells& l : planned_levels(scene)) {
    if (l.level > 0) work += std::ldexp(static_cast<double>(l.cells), l.level);
  }
  return work + followed_share * wet * (std::ldexp(1.0, 3 * scene.continuum.adapt.levels) - 1);
}

}  // namespace couloir
