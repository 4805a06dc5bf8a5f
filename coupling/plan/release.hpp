#pragma once
// The mass at the start, as both models need it.

#include "continuum/solver.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// The flow at a point of the reference surface at the start: the shape's depth, scaled to the mass where one is given.
FlowState release_at(const Scene&, double x, double y);

// [m3], exact; mass given: mass / density.
double release_volume(const Scene&);

// Is (x, y, n) in the released mass? n: height above the surface [m].
bool inside_release(const Scene&, double x, double y, double n);

}  // namespace couloir
