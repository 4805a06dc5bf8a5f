#pragma once
// Outlines of stress gauges on the face that carries them.
//
//   up                                       a round gauge is a polygon of 16 sides around the circle, its area 1.3 %
//    |   +-------------------------------+   larger; four sides lie on the square around it, `flat` to each side:
//    |   |        _____    +-------+     |                        __________
//    |   |       (     )   |       |     |                    ,-'   flat     `-.
//    |   |        -----    +-------+     |
//    |   +-------------------------------+
//    +------> across (to high y), 0 in the face's middle
//
// The box's edges are lines of the face's mesh (loop/front_mesh.hpp).

#include "coupling/scene/scene.hpp"

namespace couloir {

struct GaugeBox {
  double left = 0, right = 0, low = 0, high = 0;  // [m] of the face: across, up
};

inline constexpr int gauge_sides = 16;  // of a round one

// The rectangle, or the square around the polygon.
GaugeBox gauge_box(const StressGaugeSpec&);

// [m2] of the rectangle or of the polygon.
double gauge_area(const StressGaugeSpec&);

// [m] half of a side of the polygon, radius tan(pi / 16); 0 of a rectangle.
double gauge_flat(const StressGaugeSpec&);

// "obstacles.wall.gauges.middle"
std::string gauge_key(const Scene&, const StressGaugeSpec&);

}  // namespace couloir
