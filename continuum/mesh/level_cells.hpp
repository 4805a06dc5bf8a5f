#pragma once
#include <cstdint>

namespace couloir {

// The cells of one size that a mesh has.
struct LevelCells {
  int level = 0;    // how often the coarsest are halved
  double cell = 0;  // [m] along the slope
  std::int64_t blocks = 0, cells = 0;
};

}  // namespace couloir
