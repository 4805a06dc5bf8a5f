#pragma once
// From fluxes and sources to the new state of a block's cells, one stage of Heun's method (SSP-RK2):
//
//   predictor   q1 = q0 + dt L(q0)            friction acts on the momentum that all other terms give,
//   corrector   q  = (q0 + q1 + dt L(q1)) / 2   stops it, never turns it; what the corrector stops ends at rest

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/scratch.hpp"
#include "continuum/scheme/tally.hpp"

namespace couloir {

enum class StageName { predictor, corrector };

// sources: whether Scratch::source_x, source_y are to be added. keep_losses: whether to leave what friction took in
// Scratch::lost_x, lost_y.
void update(const Parameters&, const Block&, BlockState&, Scratch&, StageName, double dt, bool sources, bool keep_losses, Tally&);

}  // namespace couloir
