#pragma once
// A mass point that slides down the terrain with Coulomb friction, the cheapest model of an avalanche, and its energy line.
//
//   d(u^2)/dx = 2 g (sin(zeta) - mu cos(zeta)),   h_v = u^2 / (2 g)
//
// x [m] along the bed, zeta its inclination, mu = tan(delta). Exact on an incline: u^2 = u0^2 + 2 g L (sin zeta - mu cos zeta).
// The energy line, h_v above the bed, falls by mu over each metre of horizontal distance whatever the bed's shape, and the point
// stops where it meets the bed (Heim 1932; Koerner 1976). What the bed's curvature adds to the normal force is left out, as on
// the energy line: below an arc the point is too fast.

#include <vector>

#include "continuum/terrain/reference_surface.hpp"

namespace couloir {

struct MassPoint {
  double x = 0, time = 0, velocity = 0;  // [m], [s], [m/s] down the terrain
};

// At equal steps from `start` to `end` [m]; the last is where it stops, if it does before.
std::vector<MassPoint> slide(const ReferenceSurface&, double gravity, double mu, const MassPoint& start, double end, int steps);

// [m] above the bed.
double energy_head(const MassPoint&, double gravity);

}  // namespace couloir
