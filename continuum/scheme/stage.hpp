#pragma once
// One stage of the step on one block, as a table of contents. Ghosts must be filled.

#include <vector>

#include "continuum/boundary/covered_zones.hpp"
#include "continuum/scheme/bed_push.hpp"
#include "continuum/scheme/control_box.hpp"
#include "continuum/scheme/level_faces.hpp"
#include "continuum/scheme/side_faces.hpp"
#include "continuum/scheme/step_faces.hpp"
#include "continuum/scheme/update.hpp"

namespace couloir {

// Counts the volume through the x-face i (local) in the local rows [j0, j1).
struct GaugeFaces {
  int gauge, i, j0, j1;
};

// What a block knows besides its cells.
struct BlockFaces {
  StepFaces steps;
  PushedCells pushed;
  std::vector<RimFace> rim;
  std::vector<GaugeFaces> gauges;
  std::vector<BoxPart> boxes;
  std::vector<GivenFace> given;  // to coarser blocks
  std::vector<TakenFace> taken;  // from finer ones
};

// What crosses from level to level in a step: of this block from finer ones, and of all coarser ones. Null: the blocks beside it
// count as of its own size.
struct AcrossLevels {
  const LevelFluxes* from_finer = nullptr;
  std::vector<LevelFluxes>* to_coarser = nullptr;
};

void run_stage(const Parameters&, const Block&, const BlockFaces&, const CoveredZones&, AcrossLevels, BlockState&, Scratch&,
               StageName, double dt, Tally&);

// Carries the earth pressure's shares on over the time since the last step [s]; returns the fastest rate at which a signal then
// crosses a cell of this block or of an inflow beside it: max of (|u| + c_x)/dx + (|v| + c_y)/dy [1/s];
// infinite where the state is not finite.
double begin_step(const Parameters&, const Block&, const BlockFaces&, BlockState&, Scratch&, double since);

}  // namespace couloir
