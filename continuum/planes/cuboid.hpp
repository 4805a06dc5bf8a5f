#pragma once
// A cuboid as five planes (the dissertation's chapter 6): their axes, gravity on each, and the twelve edges at which planes and
// slope meet. Everything is in the frame of the slope at the cuboid's middle: x down, y across, z along the normal.
//
//                ________________
//    z          /     top       /|      plane   (a, b)   outward normal   gravity along (a, b)          onto it
//    |  y      /_______________/ | back front   (z, y)   -x               (-g cos(zeta), 0)             g sin(zeta)
//    | /      |               |  |      back    (z, y)   +x               (-g cos(zeta), 0)             0 (it pulls off)
//    |/__ x   |     left      | /       left    (x, z)   -y               (g sin(zeta), -g cos(zeta))   0
//      front  |_______________|/        right   (x, z)   +y               (g sin(zeta), -g cos(zeta))   0
//                                       top     (x, y)   +z               (g sin(zeta), 0)              g cos(zeta)
//
// On each plane depth is measured along its own normal, and planes overlap at their edges: where two are covered, the corner's
// prism is part of neither or of both. That is the method, not round-off.

#include <array>
#include <vector>

#include "continuum/boundary/side.hpp"
#include "continuum/planes/plane_flow.hpp"

namespace couloir {

enum class PlaneName { front = 0, back = 1, left = 2, right = 3, top = 4, slope = 5, none = 6 };
inline constexpr int plane_count = 5;

// Number of cells along x, y, z and their size [m].
struct CuboidCells {
  int nx = 0, ny = 0, nz = 0;
  double dx = 0, dy = 0, dz = 0;
};

// Components (x, y, z) of a plane's axes are unit vectors: 0, 1, 2 for x, y, z.
struct PlaneAxes {
  int a, b;
};
constexpr PlaneAxes axes_of(PlaneName plane) {
  switch (plane) {
    case PlaneName::front:
    case PlaneName::back:
      return {2, 1};
    case PlaneName::left:
    case PlaneName::right:
      return {0, 2};
    default:
      return {0, 1};
  }
}

// Settings of one plane; zeta: inclination of the slope [rad]. `common` brings closure, limiter, cfl, dry depth.
PlaneSettings plane_settings(PlaneName, const CuboidCells&, double gravity, double zeta, const PlaneSettings& common);

struct PlaneSide {
  PlaneName plane = PlaneName::none;  // slope: the rim of the footprint; none: the domain ends here
  SideName side = SideName::upstream;
};

struct PlaneEdge {
  enum class Kind {
    concave,  // with the slope, which is `one`
    convex,
    shed,  // upright behind a side plane: what leaves `one` falls to the slope beside it; two: the rim it falls at, its last face
    closed,  // the back plane's uprights: nothing clings round them
    domain   // `one` ends at a wall, where the domain ends
  } kind;
  PlaneSide one, two;
  int faces = 0;
  double length = 0;  // [m] of a face
};

// All edges; has_rim: by SideName, whether the slope goes on beyond that side of the footprint. Where it does not, the plane on
// that side is missing and its neighbours end at a wall.
std::vector<PlaneEdge> cuboid_edges(const CuboidCells&, const std::array<bool, 4>& has_rim);

}  // namespace couloir
