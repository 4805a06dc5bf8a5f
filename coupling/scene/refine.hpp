#pragma once
// Where a scene wants finer cells, and how many that makes.

#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

struct RefineRectangle {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // [m]
  bool empty() const { return !(x1 > x0 && y1 > y0); }
};

// What an entry of continuum.refine stands for, as given: it may be empty or reach out of the domain. The obstacle must be there.
RefineRectangle refine_rectangle(const Scene&, const RefineSpec&);

RefineRectangle within_domain(const Scene&, const RefineRectangle&);

// Cells along a block's edge: the scene's, or 32, with refinement 16 or as many as the levels need.
int block_edge(const Scene&);

// [m2] that the finest cells cover where the mesh follows the flow, about: a tenth of the wet area (seen are 0.03 to 0.06; all of
// it where the flow is few blocks across) with the usual blocks and adapt.interval, more as what asks is refined wider: by half a
// coarsest cell a step on each side, and by whole blocks. At most the domain.
double followed_area(const Scene&);

// Cells of all levels, about: those of the blocks that the rectangles meet; where the mesh follows the flow, the finest on
// followed_area().
double estimated_cells(const Scene&);

// [m2] that holds material on the mean, roughly: six footprints of the release; with an inflow the whole domain.
double wet_area(const Scene&);

}  // namespace couloir
