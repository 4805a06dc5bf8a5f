#include "coupling/plan/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/plan/build.hpp"
#include "coupling/plan/flow_estimate.hpp"
#include "coupling/scene/inflow.hpp"

namespace couloir {
namespace {

constexpr double most_overlap = 0.1;  // [d]
constexpr double bunch = 1.5;         // overlap in a bunch over that of two alone

double overlap_of_two(const Scene& scene, double speed, double modulus) {
  const double nu = scene.material.grain.poisson_ratio, stiffness = modulus / (2 * (1 - nu * nu));
  const double ratio = expected_grain_density(scene) * speed * speed / stiffness;
  return 0.5 * std::pow(5 * std::numbers::pi * std::numbers::sqrt2 / 8 * ratio, 0.4);
}

double farthest(const Scene& scene) {
  double end = 0;
  for (const ObstacleSpec& o : scene.obstacles) end = std::max(end, o.x);
  for (const ZoneBox& box : scene.grains.zones) end = std::max(end, box.x1);
  return end > 0 ? end : scene.terrain.total_length();
}

}  // namespace

double impact_speed(const Scene& scene) {
  const double end = farthest(scene);
  double most = scene.release.speed();
  for (const SideSpec& side : scene.sides) most = std::max(most, greatest_inflow(scene, side).velocity);
  for (const FlowEstimate& f : flow_estimate(scene))
    if (f.x <= end) most = std::max(most, std::abs(f.velocity) + std::sqrt(scene.gravity * f.depth));
  return most;
}

double impact_overlap(const Scene& scene, double speed) {
  return overlap_of_two(scene, speed, youngs_modulus(scene));
}

double bunch_overlap(const Scene& scene, double speed) {
  return bunch * impact_overlap(scene, speed);
}

double youngs_modulus(const Scene& scene) {
  const double given = scene.material.grain.youngs_modulus;
  if (given > 0) return given;
  const double speed = impact_speed(scene);
  for (double scale = 1;; scale *= 2)  // few values, so that scenes share their packings
    for (const double modulus : {5e6 * scale, 7e6 * scale})
      if (bunch * overlap_of_two(scene, speed, modulus) <= most_overlap) return modulus;
}

GrainStiffness grain_stiffness(const Scene& scene, double grain_density) {
  return {scene.grains.diameter, scene.grains.spread, grain_density, youngs_modulus(scene), scene.material.grain.poisson_ratio};
}

double stable_timestep(const Scene& scene, double grain_density) {
  return stable_timestep(contact_law(scene.grains.contact), grain_stiffness(scene, grain_density));
}

double engine_timestep(const Scene& scene, double grain_density) {
  return scene.grains.timestep > 0 ? scene.grains.timestep : stable_timestep(scene, grain_density);
}

}  // namespace couloir
