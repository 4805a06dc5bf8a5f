#pragma once
// Where the cells are to be halved, and how often.

#include <vector>

namespace couloir {

// Finest cells in a rectangle of the reference surface, fixed in place.
struct RefineBox {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // [m]
  int levels = 1;                         // how often the cells are halved
  double margin = 0;  // [m] by which a parent is larger than its child on each side; 0: five cells of the parent
};

// Finest cells where the flow asks for them. A block is refined by any of these; it is coarsened when front and gradient hold at
// half of their bounds no more. Obstacles and rims do not flow: those two have one bound.
struct Adaptive {
  int levels = 0;         // how often the cells may be halved; 0: not adaptive
  int interval = 8;       // steps of the coarsest cells between two looks
  bool front = true;      // where the flow ends ahead: from 1 % of the greatest depth to less
  double gradient = 0.1;  // where the surface changes between neighbouring cells by this share of the greatest depth; 0: never
  double obstacle = 0;    // [m] about obstacles, once the flow is as near; 0: never
  bool zone = true;       // along the rims of covered zones
};

struct Refinement {
  std::vector<RefineBox> boxes;
  Adaptive adaptive;
  bool empty() const { return boxes.empty() && adaptive.levels == 0; }
  int levels() const {
    int most = adaptive.levels;
    for (const RefineBox& b : boxes) most = b.levels > most ? b.levels : most;
    return most;
  }
};

}  // namespace couloir
