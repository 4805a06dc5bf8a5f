#include "coupling/plan/flow_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/plan/build.hpp"
#include "coupling/plan/mass_point.hpp"
#include "coupling/plan/release.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/release_shape.hpp"

namespace couloir {
namespace {

constexpr int stations = 400;

struct Spread {
  double volume, deepest, half_x, half_y, speed, most_y;
  double along(double time) const { return half_x + speed * time; }
  double across(double time) const { return std::min(half_y + speed * time, most_y); }
  double depth(double time) const {
    return std::min(deepest, volume / (0.5 * std::numbers::pi * along(time) * across(time)));  // paraboloid of that base
  }
};

}  // namespace

std::vector<FlowEstimate> flow_estimate(const Scene& scene) {
  const ReferenceSurface surface = reference_surface(scene);
  const GreatestInflow inflow = greatest_inflow(scene, scene.sides[0]);
  const bool fed = scene.sides[0].kind == SideSpec::Kind::inflow, uniform = scene.release.kind == ReleaseSpec::Kind::uniform;
  const Footprint base = release_footprint(scene);
  const double start = uniform || fed ? 0 : (base.x0 + base.x1) / 2;
  const double g = scene.gravity, mu = closure_of(scene).tan_delta;
  const double h0 = fed ? inflow.depth : deepest(scene), u0 = fed ? inflow.velocity : scene.release.velocity;
  const Spread spread{release_volume(scene),
                      h0,
                      (base.x1 - base.x0) / 2,
                      (base.y1 - base.y0) / 2,
                      std::sqrt(g * std::cos(surface.angle(start)) * h0),
                      scene.terrain.width / 2};

  std::vector<FlowEstimate> line;
  for (const MassPoint& point : slide(surface, g, mu, {start, 0, u0}, scene.terrain.total_length(), stations)) {
    FlowEstimate here{.x = point.x, .time = point.time, .velocity = point.velocity};
    const double u = here.velocity;
    here.depth = !(uniform || fed) ? spread.depth(here.time) : u > 0 && u0 > 0 ? std::min(h0 * u0 / u, 2 * h0) : h0;
    here.width = uniform || fed ? scene.terrain.width : 2 * spread.across(here.time);
    here.front = uniform ? scene.terrain.total_length() : fed ? here.x : here.x + spread.along(here.time);
    here.froude = u / std::sqrt(g * std::cos(surface.angle(here.x)) * here.depth);
    line.push_back(here);
  }
  return line;
}

FlowEstimate flow_estimate_at(const Scene& scene, double x) {
  const auto line = flow_estimate(scene);
  FlowEstimate nearest = line.front();
  for (const FlowEstimate& station : line) {
    if (station.x <= x) nearest = station;
  }
  return nearest;
}

}  // namespace couloir
