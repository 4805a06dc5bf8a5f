#include "continuum/noc/nested/layout.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "continuum/mesh/most_levels.hpp"

namespace couloir::noc {
namespace {

constexpr int usual_margin = 5;  // cells of the parent

struct Rectangle {
  CellBox cells;      // of the level below
  double margin = 0;  // [m]
};

void check(const Grid& g, const RefineBox& b) {
  const auto require = [](bool good, const std::string& sentence) {
    if (!good) throw std::invalid_argument(sentence);
  };
  require(b.x1 > b.x0 && b.y1 > b.y0, "A refined box is empty; give it a length and a width.");
  require(b.x1 > g.x0 && b.x0 < g.x0 + g.nx * g.dx && b.y1 > g.y0 && b.y0 < g.y0 + g.ny * g.dy,
          "A refined box lies outside of the domain; move it.");
  require(b.levels >= 1 && b.levels <= most_levels,
          "A refined box needs 1 to " + std::to_string(most_levels) + " levels; correct continuum.refine.");
  require(b.margin >= 0, "The margin of a refined box must not be negative; correct continuum.refine.");
}

bool meet(const CellBox& a, const CellBox& b) {
  return a.i0 <= b.i1 && b.i0 <= a.i1 && a.j0 <= b.j1 && b.j0 <= a.j1;
}

bool within(const CellBox& a, const CellBox& b) {
  return a.i0 >= b.i0 && a.i1 <= b.i1 && a.j0 >= b.j0 && a.j1 <= b.j1;
}

// To the side where it is near, all across where that is periodic.
void snap(int& low, int& high, int n, bool periodic, int rim) {
  low = std::max(low, 0), high = std::min(high, n);
  if (low < rim) low = 0;
  if (high > n - rim) high = n;
  if (periodic && (low == 0 || high == n)) low = 0, high = n;
}

void merge(std::vector<Rectangle>& all) {
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      CellBox& one = all[a].cells;
      const CellBox other = all[b].cells;
      if (!meet(one, other)) continue;
      one = {std::min(one.i0, other.i0), std::max(one.i1, other.i1), std::min(one.j0, other.j0), std::max(one.j1, other.j1)};
      all[a].margin = std::max(all[a].margin, all[b].margin);
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(b));
      return merge(all);
    }
  }
}

// The cells of this size that the box touches.
CellBox cells_around(const RefineBox& b, const Grid& g, double dx, double dy) {
  const auto low = [](double edge, double origin, double size) {
    return static_cast<int>(std::floor((edge - origin) / size + 1e-6));
  };
  const auto high = [](double edge, double origin, double size) {
    return static_cast<int>(std::ceil((edge - origin) / size - 1e-6));
  };
  CellBox c{low(b.x0, g.x0, dx), high(b.x1, g.x0, dx), low(b.y0, g.y0, dy), high(b.y1, g.y0, dy)};
  c.i1 = std::max(c.i1, c.i0 + 1), c.j1 = std::max(c.j1, c.j0 + 1);
  return c;
}

int half_down(int i) {
  return static_cast<int>(std::floor(0.5 * i));
}
int half_up(int i) {
  return static_cast<int>(std::ceil(0.5 * i));
}

}  // namespace

std::vector<PatchPlace> lay_patches(const Grid& g, const Refinement& refinement, bool periodic_x, bool periodic_y, int rim) {
  int levels = 0;
  for (const RefineBox& b : refinement.boxes) check(g, b), levels = std::max(levels, b.levels);
  std::vector<std::vector<Rectangle>> of(levels + 1);
  for (int level = levels; level >= 1; --level) {  // a parent is made to fit its children
    const double by = std::ldexp(1.0, 1 - level), dx = g.dx * by, dy = g.dy * by;
    const int nx = g.nx << (level - 1), ny = g.ny << (level - 1);
    std::vector<Rectangle>& here = of[level];
    for (const RefineBox& b : refinement.boxes) {
      if (b.levels == level) here.push_back({cells_around(b, g, dx, dy), b.margin});
    }
    for (std::size_t k = 0; level < levels && k < of[level + 1].size(); ++k) {
      const Rectangle& child = of[level + 1][k];
      const auto more = [&](double size) {
        const int cells = child.margin > 0 ? static_cast<int>(std::ceil(child.margin / size - 1e-6)) : usual_margin;
        return std::max(cells, rim + 1);
      };
      const int mx = more(0.5 * dx), my = more(0.5 * dy);
      const CellBox& c = child.cells;
      here.push_back({{half_down(c.i0 - mx), half_up(c.i1 + mx), half_down(c.j0 - my), half_up(c.j1 + my)}, child.margin});
    }
    for (std::size_t before = 0; before != here.size();) {  // what reaches a side may meet another
      before = here.size();
      for (Rectangle& r : here) {
        snap(r.cells.i0, r.cells.i1, nx, periodic_x, rim);
        snap(r.cells.j0, r.cells.j1, ny, periodic_y, rim);
      }
      merge(here);
    }
  }
  std::vector<PatchPlace> places;
  std::size_t parents = 0;  // where those of the level below begin
  for (int level = 1; level <= levels; ++level) {
    const std::size_t begin = places.size();
    for (const Rectangle& r : of[level]) {
      PatchPlace p{level, -1, r.cells};
      for (std::size_t k = parents; level > 1 && k < begin; ++k) {
        const CellBox& foot = places[k].foot;
        if (within(r.cells, {2 * foot.i0, 2 * foot.i1, 2 * foot.j0, 2 * foot.j1})) p.parent = static_cast<int>(k);
      }
      places.push_back(p);
    }
    parents = begin;
  }
  return places;
}

}  // namespace couloir::noc
