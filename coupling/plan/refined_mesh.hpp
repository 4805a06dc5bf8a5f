#pragma once
// The cells of a refined mesh before the run, and what they cost.

#include <vector>

#include "continuum/mesh/level_cells.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// By size, the rectangles' own counts; where the mesh follows the flow, finer ones come and go during the run. Empty: one size.
std::vector<LevelCells> planned_levels(const Scene&);

// Cells stepped in a step of the coarsest grid, dry ones left out, on the mean over a run, roughly; a level steps twice as often
// as the one before.
double cells_by_work(const Scene&);

}  // namespace couloir
