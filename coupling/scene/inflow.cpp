#include "coupling/scene/inflow.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

double silo_velocity(double gate, double diameter, double gravity) {
  constexpr double coefficient = 1.03, lost_diameters = 1.4;
  const double open = gate - lost_diameters * diameter;
  return open > 0 ? coefficient * std::sqrt(gravity) * std::pow(open, 1.5) / gate : 0;
}

GreatestInflow greatest_inflow(const Scene& scene, const SideSpec& side) {
  GreatestInflow out;
  if (side.kind != SideSpec::Kind::inflow) return out;
  switch (side.inflow) {
    case SideSpec::Inflow::uniform:
      return {side.depth, side.velocity};
    case SideSpec::Inflow::silo:
      return {side.gate, silo_velocity(side.gate, scene.material.diameter, scene.gravity)};
    case SideSpec::Inflow::hydrograph:
      break;
  }
  for (const InflowRow& row : side.hydrograph) {
    out.depth = std::max(out.depth, row.depth);
    out.velocity = std::max(out.velocity, row.velocity);
  }
  return out;
}

double inflow_volume(const Scene& scene, const SideSpec& side) {
  if (side.kind != SideSpec::Kind::inflow) return 0;
  if (side.inflow != SideSpec::Inflow::hydrograph) {
    const GreatestInflow q = greatest_inflow(scene, side);
    return q.depth * q.velocity * scene.duration;
  }
  double volume = 0;
  for (std::size_t k = 1; k < side.hydrograph.size(); ++k) {
    // The product of two linear functions, by Simpson's rule exact.
    const InflowRow &a = side.hydrograph[k - 1], &b = side.hydrograph[k];
    const double middle = (a.depth + b.depth) * (a.velocity + b.velocity);
    volume += (b.time - a.time) * (a.depth * a.velocity + middle + b.depth * b.velocity) / 6;
  }
  return volume;
}

}  // namespace couloir
