#pragma once
// Triangles of the bed, of obstacles and of side walls in the tilted frame, from pieces of the reference surface.

#include <vector>

#include "continuum/terrain/reference_surface.hpp"
#include "coupling/engine/grain_engine.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

struct Patch {
  double x0, x1, y0, y1;  // [m] reference coordinates
};

// The bed under a patch; edges at most `size` [m] long, and within a thousandth of it from an arc.
std::vector<Triangle> bed_mesh(const ReferenceSurface&, const Patch&, double size);
// An obstacle's triangles: those of each of its stress gauges, and all others.
struct ObstacleMesh {
  std::vector<Triangle> rest;
  std::vector<std::vector<Triangle>> gauges;
};

// Five faces of a block that stands on the bed, axis along the normal at the middle of its footprint.
ObstacleMesh cuboid_mesh(const ReferenceSurface&, const ObstacleSpec&, double size,
                         const std::vector<StressGaugeSpec>& gauges = {});
// The three upper faces of a wedge, its base on the tangent plane at the foot of its peak. The triangles turn their normal
// (b - a) x (c - a) out of the body.
std::vector<Triangle> tetrahedron_mesh(const ReferenceSurface&, const ObstacleSpec&, double size);
// The triangles of an obstacle of shape mesh, long edges cut.
std::vector<Triangle> body_mesh(const ReferenceSurface&, const ObstacleSpec&, double size);
// Whichever of them the obstacle is; only a cuboid has gauges.
ObstacleMesh obstacle_mesh(const ReferenceSurface&, const ObstacleSpec&, double size,
                           const std::vector<StressGaugeSpec>& gauges = {});
// The least and the greatest coordinates [m] of all from the bed up to `height` along its normal, between x0 and x1 on y = 0.
struct Extent {
  Eigen::Vector3d lo, hi;
};
Extent extent(const ReferenceSurface&, double x0, double x1, double height);

// A wall that stands on the bed (beside an arc: reaches below it) along y = const from x0 to x1, or along x = const from y0 to
// y1; `height` [m].
std::vector<Triangle> side_mesh(const ReferenceSurface&, double x0, double x1, double y, double height, double size);
std::vector<Triangle> end_mesh(const ReferenceSurface&, double x, double y0, double y1, double height, double size);

}  // namespace couloir
