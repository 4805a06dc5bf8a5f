#pragma once
// Faces between cells of two sizes. The finer cells' fluxes are what passes: summed over their two halves and the two halves of
// the coarser step, they are what the coarser cell gets; so mass is kept to round-off, and where no bed pushes momentum too.
// Finer blocks therefore step first.
//
//            |    F f1
//     coarse o----F        flux of the coarser face = mean of f1, f2 over both finer steps
//            |    F f2
//
// Where the bed rises at the face, or at a step, each side feels its own push, as everywhere (face_flux.hpp): the coarser cell its own
// pressure p(h), and of the finer faces what goes beyond theirs.

#include <vector>

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/axis.hpp"
#include "continuum/scheme/scratch.hpp"

namespace couloir {

// What passed a coarser cell's face, mean over its step.
struct LevelFlux {
  double mass = 0, tangent = 0, normal = 0;  // as FaceFluxes
  double push = 0;                           // what the coarser side feels beyond `normal` and p(h)
  double bed = 0;                            // share of the face on which the bed pushes
};
// Of a coarser block, by slot.
using LevelFluxes = std::vector<LevelFlux>;

// A face of this block whose other cell, a ghost, is coarser.
struct GivenFace {
  int face;
  bool along_x, coarser_below;
  int block, slot;  // of the coarser block
};

// A face of this block whose other cell, a ghost, is finer.
struct TakenFace {
  int face;
  bool along_x, finer_above;
  int slot;
};

// Adds one stage of a finer step to what the coarser blocks will get.
void give_to_coarser(const std::vector<GivenFace>&, const Block&, const Axis&, const FaceValues&, std::vector<LevelFluxes>&);

// Replaces the fluxes to finer cells.
void take_from_finer(const std::vector<TakenFace>&, const Block&, const Axis&, const FaceValues&, const LevelFluxes&);

}  // namespace couloir
