#pragma once
// Obstacles as bed elevation for several tests: the dissertation's wall (24 to 1) and wedge, lengths in its units of 33.33 mm.

#include "continuum/terrain/elevation.hpp"
#include "scenes.hpp"

namespace couloir::test {

constexpr double unit = 0.03333;  // [m]

// The wall of figure 4.7 on cells of 0.1 units: its sides rise by 2.4 within one cell.
inline Elevation wall_24_to_1(double x0 = 16 * unit) {
  Elevation e;
  const double ramp = 0.1 * unit;
  e.add(ElevationBody::cuboid(0, "wall", x0, x0 + 1.1 * unit, -2.4 * unit, 2.4 * unit, 2.4 * unit, ramp, ramp));
  return e;
}

// The wedge of section 5.3.2.
inline Elevation wedge(double x = 14 * unit) {
  Elevation e;
  e.add(ElevationBody::tetrahedron(0, "wedge", x, 0, 2 * std::sqrt(3.0) * unit, 4 * unit, 1.8 * unit));
  return e;
}

// On a solver's grid; every obstacle of the list is elevation.
inline StepBed bed_of(const Elevation& e, const Grid& g) {
  StepBed bed;
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      bed.elevation.push_back(e.at(g.x(i), g.y(j)));
      bed.owner.push_back(bed.elevation.back() > 0 ? e.obstacle_at(g.x(i), g.y(j)) : -1);
    }
  }
  for (const ElevationBody& b : e.bodies()) bed.obstacles.push_back({b.name(), b.x0(), b.x1(), b.y0(), b.y1(), 0});
  return bed;
}

}  // namespace couloir::test
