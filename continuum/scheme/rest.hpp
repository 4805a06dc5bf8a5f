#pragma once
// Which cells are locked: without momentum, and driven by less than friction can hold,
//
//   |(tan(zeta) - K_x d(eta)/dx - (1 - K_x) d(z_b)/dx,  -K_y d(eta)/dy - (1 - K_y) d(z_b)/dy)| <= tan(delta)
//
// with the mean of the two one-sided gradients in each direction, and each one-sided gradient alone must pass the test too, so
// that a spike is not locked. K is what serves best of the states from active to the one reached, or the pressures are those of
// both cells, K h^2 / 2 each. A side where a wall or a higher bed stands above the cell's surface has no gradient, and holds what
// is driven against it. A dry cell is locked; a covered cell is not.

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/scratch.hpp"

namespace couloir {

// scratch.loose in the interior and the first ghost layer; scratch.locked. Needs find_velocity().
void find_locked(const Parameters&, const Block&, const BlockState&, Scratch&);

}  // namespace couloir
