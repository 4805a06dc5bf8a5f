#pragma once
// Earth pressure coefficients between active and passive, by what the material has undergone.
//
//   The share of the passive state x moves with the material and follows its strain, kept in [0, 1]:
//
//     dx/dt + u . grad x = -(du/dx) / passive_strain
//
//   Compressed by passive_strain it is passive, stretched by as much active again; at rest it stays as it is, somewhere between.
//   The same for y with dv/dy. (2.85), (2.86) with their jump at du/dx = 0 are its limit for no strain at all.
//   docs/decisions/0004.

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/min_max.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/scratch.hpp"
#include "continuum/scheme/step_faces.hpp"

namespace couloir {

// Carries the shares of the interior on by dt [s]. Needs find_velocity() of the present state and the shares in the ghosts. Dry
// neighbours have no say in du/dx; a wall that the flow cannot pass counts as its mirror image.
void mobilise(const Parameters&, const Block&, const StepFaces&, BlockState&, Scratch&, double dt);

// K_x, K_y of all cells by their shares.
void find_earth_pressure(const Parameters&, const Block&, const BlockState&, Scratch&);

// The K of the stable step: waves of K h; and disturbances of K, which cross one cell a step at most, at the CFL number 0.45 a
// fifth of their speed squared.
inline double k_of_step(double k, double stiffness) {
  return larger(k, 0.2 * (k + stiffness));
}

}  // namespace couloir
