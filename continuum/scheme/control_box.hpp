#pragma once
// The momentum of the flow in a box of cells, term by term as the scheme applies it: what came through the box's faces (pressure
// included), by the downslope weight, and by friction. What is then missing in the change of the momentum is what the bodies
// inside took: the force on an obstacle, seen from around it.

#include <array>
#include <vector>

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/axis.hpp"
#include "continuum/scheme/tally.hpp"

namespace couloir {

// The part of a box in one block, local indices [i0, i1) x [j0, j1); and which of its ends are the box's own.
struct BoxPart {
  int box;
  int i0, i1, j0, j1;
  std::array<bool, 4> end;  // by SideName
};

// What comes in through the box's faces across this axis; share: what this stage counts in the step, times dt [s].
void count_box_faces(const std::vector<BoxPart>&, const Block&, const Axis&, double share, Tally&);

// The weight along the slope of the state before the update.
void count_box_weight(const std::vector<BoxPart>&, const Block&, const BlockState&, double share, Tally&);

// Friction, and momentum dropped in films, as the update wrote them (Scratch::lost_x, lost_y).
void count_box_friction(const std::vector<BoxPart>&, const Block&, const Scratch&, Tally&);

}  // namespace couloir
