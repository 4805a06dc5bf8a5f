#pragma once
// What hits an obstacle, by the formulas that protective works are dimensioned with, before anything is computed.
//
//   F = rho b (u^2 sin^2(theta) h + g cos(zeta) h^2 / 2)
//
// The first term is the flow's momentum that a face at theta against the bed takes up (Salm, Burkard and Gubler 1990), the second
// the hydrostatic pressure of the same depth. u, h: of the mass point and its spreading mass (flow_estimate.hpp) when the middle
// is there, h at most the obstacle's height; b: width [m] of the obstacle, at most the flow's; rho: bulk density [kg/m3]. No
// jump, no pile, no flow around: good to a factor of two or three.

#include <optional>
#include <string>
#include <vector>

#include "coupling/plan/flow_estimate.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

struct ImpactEstimate {
  std::string obstacle;
  double arrival = 0;                   // [s] of the front
  double velocity = 0, depth = 0;       // [m/s], [m]
  double dynamic = 0, hydrostatic = 0;  // [N] along the slope
  double force() const { return dynamic + hydrostatic; }
};

// The first term's and the second's, [N].
double dynamic_force(double density, double velocity, double depth, double width, double face);
double hydrostatic_force(double density, double normal_gravity, double depth, double width);

// Of each obstacle that the flow gets to within the run, in the scene's order.
std::vector<ImpactEstimate> impact_estimates(const Scene&);

// [s] when the front is at x; nothing: it stops before, or the run ends before.
std::optional<double> front_arrival(const Scene&, const std::vector<FlowEstimate>&, double x);

// [m] where the middle of the flow stops; nothing: it leaves the terrain.
std::optional<double> run_out(const std::vector<FlowEstimate>&);

}  // namespace couloir
