#pragma once
// The geometry of the release as it is described, before its depth is scaled to a mass.

#include "coupling/scene/scene.hpp"

namespace couloir {

struct Footprint {
  double x0, x1, y0, y1;  // [m]
};

// The smallest rectangle around the release; uniform: the whole domain; none: the middle of the upper edge.
Footprint release_footprint(const Scene&);

// [m3], exact: cap pi H (3 a^2 + H^2) / 6, semi-ellipsoid 2/3 pi a b c, block, uniform (less the obstacles' footprints).
double shape_volume(const Scene&);

// [m] depth of the shape at a point, before scaling; 0 outside.
double shape_depth(const Scene&, double x, double y);

// Depth of the flow over depth of the shape: mass / (density * volume of the shape), 1 where no mass is given.
double depth_scale(const Scene&);

// [m] greatest depth of the release, scaled.
double deepest(const Scene&);

}  // namespace couloir
