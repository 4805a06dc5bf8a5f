#pragma once
// What an obstacle made of bed elevation takes from the flow: the bed's push on the cells over it and beside it, as the scheme
// itself applies it (bed_source() and the jumps at the faces). So the momentum budget closes with it to round-off, and in the
// limit of small cells it is the integral of (7.1), (7.2) over the body. Per density: g cos(zeta) h dz_b/dx dx dy [m4/s2].

#include <vector>

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/axis.hpp"
#include "continuum/scheme/tally.hpp"

namespace couloir {

struct PushedCells {
  std::vector<int> cells;  // of the block's interior, where an obstacle's elevation pushes

  PushedCells() = default;
  explicit PushedCells(const Block&);
};

// Books the push along this axis on the obstacles and in the budget; share: what this stage counts in the step, times dt [s].
void count_bed_push(const PushedCells&, const Block&, const BlockState&, const Axis&, double share, Tally&);

}  // namespace couloir
