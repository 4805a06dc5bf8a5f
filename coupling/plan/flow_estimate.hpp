#pragma once
// What the flow will be like, before anything is computed: the energy line with Coulomb friction, and a mass that spreads.

#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

struct FlowEstimate {
  double x = 0;         // [m]
  double time = 0;      // [s] when the middle of the mass is there
  double velocity = 0;  // [m/s]
  double depth = 0;     // [m]
  double froude = 0;    // u / sqrt(g cos(zeta) h)
  double width = 0;     // [m] across the slope
  double front = 0;     // [m] where the flow's front is then
};

// Stations of a mass point (mass_point.hpp) from the middle of the release (uniform: the upper edge) down the terrain, as far as
// it gets, however long that takes. A finite mass spreads on both axes with sqrt(g cos(zeta) h0); a fed flow keeps h u. Good to a
// factor of two in depth: for planning only.
std::vector<FlowEstimate> flow_estimate(const Scene&);

// At x; the first station upstream of them all, the last downstream.
FlowEstimate flow_estimate_at(const Scene&, double x);

}  // namespace couloir
