#include "coupling/scene/inflow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/scene/units.hpp"

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

std::vector<std::string> inflow_assumptions(const Scene& scene) {
  std::vector<std::string> out;
  const char* names[] = {"upstream", "downstream", "left", "right"};
  for (int side = 0; side < 4; ++side) {
    const SideSpec& spec = scene.sides[side];
    if (spec.kind != SideSpec::Kind::inflow || spec.inflow != SideSpec::Inflow::silo || scene.material.diameter > 0) continue;
    // A hundredth and a tenth of the gate, say what the missing diameter may do.
    const auto less = [&](double share) {
      return 100 * (1 - silo_velocity(spec.gate, share * spec.gate, scene.gravity) / silo_velocity(spec.gate, 0, scene.gravity));
    };
    out.push_back(
        fmt::format("The material has no diameter: the silo's rate {} is assumed to be that of grains without size, the "
                    "most the gate lets through; grains of {} would bring {:.2g} % less, of {} {:.2g} %. Give "
                    "material.diameter.",
                    names[side], short_quantity(0.01 * spec.gate, Dimension::length), less(0.01),
                    short_quantity(0.1 * spec.gate, Dimension::length), less(0.1)));
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
