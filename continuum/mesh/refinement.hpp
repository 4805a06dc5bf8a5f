#pragma once
// Where a scene wants finer cells.

#include <vector>

namespace couloir {

// [m] finest cells in this rectangle; levels: how often the cells are halved; margin [m]: how much larger a parent is than its
// child on each side, 0: five cells of the parent
struct RefineBox {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  int levels = 1;
  double margin = 0;
};

struct Refinement {
  std::vector<RefineBox> boxes;
  bool empty() const { return boxes.empty(); }
};

}  // namespace couloir
