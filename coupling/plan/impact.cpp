#include "coupling/plan/impact.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/plan/validity.hpp"

namespace couloir {

double dynamic_force(double density, double velocity, double depth, double width, double face) {
  return density * std::pow(velocity * std::sin(face), 2) * depth * width;
}

double hydrostatic_force(double density, double normal_gravity, double depth, double width) {
  return density * normal_gravity * depth * depth / 2 * width;
}

std::optional<double> front_arrival(const Scene& scene, const std::vector<FlowEstimate>& line, double x) {
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k].front < x) continue;
    double time = line[k].time;
    if (k > 0) {
      const FlowEstimate &a = line[k - 1], &b = line[k];
      time = a.time + (x - a.front) / (b.front - a.front) * (b.time - a.time);
    }
    return time <= scene.duration ? std::optional(time) : std::nullopt;
  }
  return std::nullopt;
}

std::optional<double> run_out(const std::vector<FlowEstimate>& line) {
  return line.back().velocity == 0 ? std::optional(line.back().x) : std::nullopt;
}

std::vector<ImpactEstimate> impact_estimates(const Scene& scene) {
  std::vector<ImpactEstimate> out;
  const std::vector<FlowEstimate> line = flow_estimate(scene);
  const ReferenceSurface surface = reference_surface(scene);
  for (const ObstacleSpec& o : scene.obstacles) {
    const std::optional<double> arrival = front_arrival(scene, line, o.x);
    if (!arrival) continue;
    // Where the middle stops before, as it is when the front is there.
    const auto last = std::ranges::find_if(line, [&](const FlowEstimate& f) { return f.time > *arrival; });
    const FlowEstimate flow = line.back().x >= o.x ? flow_estimate_at(scene, o.x) : last == line.begin() ? *last : *(last - 1);
    const double depth = std::min(flow.depth, o.height), width = std::min(flow.width, o.width);
    const double face = turn_at(o, flow.depth).angle, rho = scene.material.density;
    out.push_back({o.name, *arrival, flow.velocity, flow.depth, dynamic_force(rho, flow.velocity, depth, width, face),
                   hydrostatic_force(rho, scene.gravity * std::cos(surface.angle(o.x)), depth, width)});
  }
  return out;
}

}  // namespace couloir
