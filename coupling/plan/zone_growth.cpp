#include "coupling/plan/zone_growth.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"

namespace couloir {
namespace {

class Lines {
 public:
  Lines(const Scene& scene, const CellBox& planned, const std::vector<CellBox>& others)
      : scene_(scene), grid_(grid_of(scene)), planned_(planned), widest_(planned), others_(others) {}

  ZoneLines all() {
    const double d = scene_.grains.diameter;
    const int along = planned_.i1 - planned_.i0, across = planned_.j1 - planned_.j0;
    const int step_x = std::max(cells(15 * d, grid_.dx), (along + 3) / 4),
              step_y = std::max(cells(12 * d, grid_.dy), (across + 3) / 4);
    const int room_x = cells(6 * d, grid_.dx), room_y = cells(6 * d, grid_.dy);
    const auto closed = [&](int side) { return scene_.sides[side].kind != SideSpec::Kind::inflow; };
    std::vector<int> up, down, low, high;
    if (scene_.grains.follow) {
      const int layer = cells(4 * d, grid_.dx);
      for (int n = 0; n < 4 && widest_.i0 - step_x >= layer && widen({widest_.i0 - step_x, widest_.i1, widest_.j0, widest_.j1});
           ++n)
        up.push_back(widest_.i0);
      for (int n = 0; n < 2 && widest_.i1 < grid_.nx; ++n) {
        int to = widest_.i1 + step_x;
        if (to > grid_.nx - room_x) to = grid_.nx;
        if ((to == grid_.nx && !closed(1)) || !widen({widest_.i0, to, widest_.j0, widest_.j1})) break;
        down.push_back(to);
      }
      // Both or none, so that a symmetric scene keeps symmetric steps.
      for (int n = 0; n < 2 && widest_.j0 > 0 && widest_.j1 < grid_.ny; ++n) {
        int to = widest_.j0 - step_y, past = widest_.j1 + step_y;
        if (to < room_y) to = 0;
        if (past > grid_.ny - room_y) past = grid_.ny;
        if ((to == 0 && !closed(2)) || (past == grid_.ny && !closed(3)) || !widen({widest_.i0, widest_.i1, to, past})) break;
        low.push_back(to), high.push_back(past);
      }
    }
    return {joined(up, planned_.i0, planned_.i1, down), joined(low, planned_.j0, planned_.j1, high), int(up.size()),
            int(low.size())};
  }

 private:
  static int cells(double length, double step) { return std::max(1, int(std::ceil(length / step - 1e-9))); }

  static std::vector<int> joined(std::vector<int> before, int a, int b, const std::vector<int>& after) {
    std::reverse(before.begin(), before.end());
    before.insert(before.end(), {a, b});
    before.insert(before.end(), after.begin(), after.end());
    return before;
  }

  bool widen(const CellBox& to) {
    const double d = scene_.grains.diameter;
    ZoneBox box = box_of(to, grid_);
    box = {box.x0 - 5 * d, box.x1 + 5 * d, box.y0 - 5 * d, box.y1 + 5 * d};
    const ZoneBox own = box_of(planned_, grid_);
    for (const ObstacleSpec& o : scene_.obstacles)
      if (!own.holds(o) && !box.apart(o)) return false;
    const int gap_x = cells(30 * d, grid_.dx), gap_y = cells(30 * d, grid_.dy);  // layers, buffers
    const bool periodic = scene_.sides[2].kind == SideSpec::Kind::periodic;
    for (const CellBox& other : others_)
      for (const int shift : {-grid_.ny, 0, grid_.ny})
        if ((shift == 0 || periodic) && to.i0 - gap_x < other.i1 && other.i0 < to.i1 + gap_x &&
            to.j0 - gap_y < other.j1 + shift && other.j0 + shift < to.j1 + gap_y)
          return false;
    if (!layers_can_follow(scene_, to)) return false;
    widest_ = to;
    return true;
  }

  const Scene& scene_;
  Grid grid_;
  CellBox planned_, widest_;
  const std::vector<CellBox>& others_;
};

}  // namespace

bool layers_can_follow(const Scene& scene, const CellBox& zone) {
  const Grid grid = grid_of(scene);
  if (zone.j0 == 0 && zone.j1 == grid.ny) return true;
  const ZoneBox box = box_of(zone, grid);
  int beside = 0;
  for (const TerrainArc& arc : scene.terrain.arcs()) {
    if (box.x1 <= arc.begin || box.x0 >= arc.begin + arc.length) continue;
    if (arc.turn < 0) return false;
    ++beside;
  }
  return beside <= 1;
}

ZoneLines growth_lines(const Scene& scene, const CellBox& planned, const std::vector<CellBox>& others) {
  return Lines(scene, planned, others).all();
}

}  // namespace couloir
