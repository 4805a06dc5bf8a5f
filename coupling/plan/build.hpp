#pragma once
// Scene -> what the continuum and the engine are made of.

#include "continuum/noc/noc_solver.hpp"
#include "continuum/solver.hpp"
#include "continuum/terrain/elevation.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// Cells of nearly the asked size that fill the domain; x from 0, y symmetric about 0 with an even number of rows. In mode
// continuum a domain narrower than 1.5 cells is one row: the 1D model (2.2), (2.11). A scene in mode grains may have no cell
// size: then 2 d, for its records.
Grid grid_of(const Scene&);

SolverSettings solver_settings(const Scene&);
// z_b(x, y) of the obstacles by method elevation, each by its number in the scene.
Elevation elevation(const Scene&);
// central_upwind: steps, and the elevation, as it is and sampled at the cell centres of grid_of().
StepBed step_bed(const Scene&);
NocBed noc_bed(const Scene&);  // noc: the elevation alone
ReferenceSurface reference_surface(const Scene&);
Closure closure_of(const Scene&);  // mode grains: hydraulic, whatever the angles

// The cells between the lines nearest to the box's edges.
CellBox cells_in(const ZoneBox&, const Grid&);
ZoneBox box_of(const CellBox&, const Grid&);

// Of a settled block on a flat base; measured values lie at .563-.579. The real packing's own value replaces it in a run.
inline constexpr double expected_solid_fraction = 0.57;

double expected_grain_density(const Scene&);  // [kg/m3]

// [m3] mean volume of a grain: radii uniform within +-spread of the mean.
double mean_grain_volume(const GrainSpec&);

}  // namespace couloir
