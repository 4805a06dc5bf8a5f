#pragma once
// What follows from a cell's depth and momenta alone.

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/scratch.hpp"

namespace couloir {

// u, v, eta in all cells, ghosts included; no velocity where the depth is below dry_depth. And Scratch::still.
void find_velocity(const Parameters&, const Block&, const Fields&, Scratch&);

}  // namespace couloir
