#pragma once
// Faces where the bed jumps: between cells of different step height.
//
//   A face is solid up to the higher side's top. What reaches above it passes (hydrostatic reconstruction); the rest is turned
//   back as by a wall:
//
//     normal flux seen from one side = HLL(h*l, ul, h*r, ur) + wall_flux(h, u) - wall_flux(h*, u)
//
//   and that blocked part is the force on the obstacle. No slopes are drawn across a step face.

#include <vector>

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/axis.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/tally.hpp"

namespace couloir {

struct StepFaces {
  std::vector<int> x, y;   // face indices that the block's fluxes or slopes meet
  std::vector<int> cells;  // cells of the interior that touch one

  StepFaces() = default;
  explicit StepFaces(const Block&);
  const std::vector<int>& along(const Axis& axis) const { return axis.along_x ? x : y; }
};

// No slopes in the cells that touch a step face.
void flatten_at_steps(const StepFaces&, const Block&, const Fields&, const Scratch&, const Axis&, FaceValues&);

// Replaces the fluxes through the step faces.
void step_face_fluxes(const Parameters&, const StepFaces&, const Block&, const Scratch&, const Axis&, const FaceValues&);

// Books the blocked part on the obstacles and in the budget; share: what this stage counts in the step, times dt [s].
void count_step_faces(const StepFaces&, const Block&, const BlockState&, const Axis&, double share, Tally&);

}  // namespace couloir
