#pragma once
// What follows from a cell's depth and momenta: velocity, surface, earth pressure coefficients.

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/scratch.hpp"
#include "continuum/scheme/step_faces.hpp"

namespace couloir {

// u, v, eta in all cells, ghosts included; no velocity where the depth is below dry_depth.
void find_velocity(const Parameters&, const Block&, const Fields&, Scratch&);

// K_x, K_y in the interior and the first ghost layer by (2.85), (2.86), made continuous: active while the flow stretches, passive
// once it is compressed at a rate of 0.1 sqrt(g cos(zeta) / h), and in proportion between. Dry neighbours have no say in du/dx; a
// wall that the flow cannot pass counts as its mirror image; a cell at rest is active. docs/decisions/0004.
void find_earth_pressure(const Parameters&, const Block&, const StepFaces&, const Fields&, Scratch&);

}  // namespace couloir
