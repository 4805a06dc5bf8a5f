#pragma once
// The upstream face of a cuboid, cut into its stress gauges and the rest, as plane triangles.

#include <array>
#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

// Shares of the face's lengths: across from low y, up from the foot.
using FacePoint = std::array<double, 2>;
using FaceTriangle = std::array<FacePoint, 3>;

struct FrontMesh {
  std::vector<double> across, up;  // lines from 0 to 1 whose nodes the neighbouring faces share
  std::vector<FaceTriangle> rest;
  std::vector<std::vector<FaceTriangle>> gauges;
};

// Of the face of `o` with gauges that have passed check_stress_gauges. Together rest and gauges cover the face once; in the rest
// no node lies within an edge. Triangles turn from across to up; lines are about `size` [m] apart at most.
//
//   Lines run through all edges of all gauges' boxes. A cell of them belongs to a rectangle or to the rest; in the square around
//   a round gauge the rest has the corners that the polygon leaves:
//
//      o---*---o--*----o     o: on lines
//      |  *        *   |     *: of the polygon; those on the square's sides are nodes of the cells beyond, too
//      o *          *  o
//      | |          |  |
FrontMesh front_mesh(const ObstacleSpec& o, const std::vector<StressGaugeSpec>& gauges, double size);

}  // namespace couloir
