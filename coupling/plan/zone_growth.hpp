#pragma once
// How far a zone may grow from where it is planned, in steps: cell lines that its sides can lie on.
//
//     x lines   | . . . | . . . |=== planned ===| . . |     upstream at most 4 steps of max(15 d, a quarter of its length),
//               u2      u1                      d1          downstream 2; to either side 2 of max(12 d, a quarter of its width)
//
// No step reaches an obstacle that the zone does not hold, nor within 4 d of an upstream side or 6 d of another one (that last
// step ends on the side, unless material comes in there).

#include <vector>

#include "continuum/solver.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

struct ZoneLines {
  std::vector<int> x, y;  // cells, ascending; x[at_x], x[at_x + 1] are the planned zone's own edges, y alike
  int at_x = 0, at_y = 0;
};

// Whether the zone's sides along the slope, where it has some within the domain, lie beside one arc at most and no brink: their
// driven layers turn about one axis.
bool layers_can_follow(const Scene&, const CellBox& zone);

// `others`: zones that it must keep clear of. Without scene.grains.follow: the planned edges alone.
ZoneLines growth_lines(const Scene&, const CellBox& planned, const std::vector<CellBox>& others);

}  // namespace couloir
