#include "continuum/mesh/wishes.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

std::vector<Wish> wishes_of(const std::vector<RefineBox>& boxes) {
  std::vector<Wish> all;
  for (const RefineBox& b : boxes) {
    for (int level = 1; level <= b.levels; ++level) {
      const double more = b.margin * (b.levels - level);
      all.push_back({b.x0 - more, b.x1 + more, b.y0 - more, b.y1 + more, level});
    }
  }
  return all;
}

void wrap(std::vector<Wish>& wishes, const Grid& grid, bool periodic_x, bool periodic_y) {
  const auto over = [&](double Wish::*low, double Wish::*high, double from, double length) {
    for (std::size_t k = 0, given = wishes.size(); k < given; ++k) {
      const auto add = [&](double by) {
        Wish w = wishes[k];
        w.*low += by, w.*high += by;
        wishes.push_back(w);
      };
      const double below = wishes[k].*low, above = wishes[k].*high;
      if (below < from) add(length);
      if (above > from + length) add(-length);
    }
  };
  if (periodic_x) over(&Wish::x0, &Wish::x1, grid.x0, grid.nx * grid.dx);
  if (periodic_y) over(&Wish::y0, &Wish::y1, grid.y0, grid.ny * grid.dy);
}

int wished_level(const std::vector<Wish>& wishes, const Leaf& leaf, const Grid& grid, int edge) {
  const double width = edge * grid.dx, height = edge * grid.dy;
  const double x0 = grid.x0 + std::ldexp(leaf.bi * width, -leaf.level), x1 = x0 + std::ldexp(width, -leaf.level);
  const double y0 = grid.y0 + std::ldexp(leaf.bj * height, -leaf.level), y1 = y0 + std::ldexp(height, -leaf.level);
  const double slack = 1e-9 * std::ldexp(std::min(width, height), -leaf.level);
  int level = 0;
  for (const Wish& w : wishes) {
    const bool meets = w.x0 < x1 - slack && w.x1 > x0 + slack && w.y0 < y1 - slack && w.y1 > y0 + slack;
    if (meets) level = std::max(level, w.level);
  }
  return level;
}

bool grow(Forest& forest, const std::vector<Wish>& wishes, const Grid& grid, int edge) {
  return forest.adapt([&](const Leaf& leaf) { return wished_level(wishes, leaf, grid, edge); });
}

void grow_fully(Forest& forest, const std::vector<Wish>& wishes, const Grid& grid, int edge) {
  while (grow(forest, wishes, grid, edge)) {
  }
}

std::vector<LevelCells> count_levels(const Grid& grid, int edge, bool periodic_x, bool periodic_y,
                                     const std::vector<RefineBox>& boxes) {
  Refinement refinement;
  refinement.boxes = boxes;
  const int levels = refinement.levels();
  Forest forest((grid.nx + edge - 1) / edge, (grid.ny + edge - 1) / edge, periodic_x, periodic_y, levels);
  std::vector<Wish> wishes = wishes_of(boxes);
  wrap(wishes, grid, periodic_x, periodic_y);
  grow_fully(forest, wishes, grid, edge);
  std::vector<LevelCells> count;
  for (int level = 0; level <= levels; ++level) count.push_back({level, grid.refined(level).dx, 0, 0});
  for (const Leaf& leaf : forest.leaves()) {
    const Grid fine = grid.refined(leaf.level);
    const int nx = std::min(edge, fine.nx - leaf.bi * edge), ny = std::min(edge, fine.ny - leaf.bj * edge);
    if (nx <= 0 || ny <= 0) continue;
    ++count[leaf.level].blocks;
    count[leaf.level].cells += std::int64_t{nx} * ny;
  }
  return count;
}

}  // namespace couloir
