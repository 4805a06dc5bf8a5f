#pragma once
// Where the patches of nested grids lie: the tree of section 5.1.1, laid out by hand (section 5.2).
//
//   level 0   |_______|_______|_______|_______|_______|_______|     the base grid
//   level 1           |___|___|___|___|___|___|                     a patch covers whole cells of its parent
//   level 2                   |_|_|_|_|                             and lies inside of it

#include <vector>

#include "continuum/mesh/grid.hpp"
#include "continuum/mesh/refinement.hpp"

namespace couloir::noc {

struct PatchPlace {
  int level = 1;
  int parent = -1;  // number of the patch that it lies in; -1: the base grid
  CellBox foot;     // the cells of level - 1 that it covers, counted from the lower corner of the domain
};

// Parents before their children. Boxes are enlarged to whole cells of the parent; patches of one level that overlap or touch
// become their bounding box; a patch that comes nearer to a side of the domain than `rim` cells of its parent reaches the side,
// and one that reaches a periodic side spans the domain. A parent is at least `rim` + 1 of its cells larger than its child.
// Throws std::invalid_argument where a box is empty, lies outside of the domain, or has no levels or more than most_levels.
std::vector<PatchPlace> lay_patches(const Grid& base, const Refinement&, bool periodic_x, bool periodic_y, int rim);

}  // namespace couloir::noc
