#include "coupling/plan/flow_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/plan/build.hpp"
#include "coupling/plan/release.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/release_shape.hpp"

namespace couloir {
namespace {

constexpr int stations = 400;

struct Spread {
  double volume, deepest, half_x, half_y, speed, most_y;
  double depth(double time) const {
    const double lx = half_x + speed * time, ly = std::min(half_y + speed * time, most_y);
    return std::min(deepest, volume / (0.5 * std::numbers::pi * lx * ly));  // paraboloid of that base
  }
};

}  // namespace

std::vector<FlowEstimate> flow_estimate(const Scene& scene) {
  const ReferenceSurface surface = reference_surface(scene);
  const GreatestInflow inflow = greatest_inflow(scene, scene.sides[0]);
  const bool fed = scene.sides[0].kind == SideSpec::Kind::inflow, uniform = scene.release.kind == ReleaseSpec::Kind::uniform;
  const Footprint base = release_footprint(scene);
  const double start = uniform || fed ? 0 : (base.x0 + base.x1) / 2;
  const double g = scene.gravity, mu = std::tan(scene.material.delta);
  const double h0 = fed ? inflow.depth : deepest(scene), u0 = fed ? inflow.velocity : scene.release.velocity;
  const Spread spread{release_volume(scene),
                      h0,
                      (base.x1 - base.x0) / 2,
                      (base.y1 - base.y0) / 2,
                      std::sqrt(g * std::cos(surface.angle(start)) * h0),
                      scene.terrain.width / 2};

  std::vector<FlowEstimate> line;
  const double step = (scene.terrain.total_length() - start) / stations;
  double time = 0, u = u0;
  for (int n = 0; n <= stations; ++n) {
    FlowEstimate here;
    here.x = start + n * step;
    here.time = time;
    here.velocity = u;
    const double zeta = surface.angle(here.x);
    here.depth = !(uniform || fed) ? spread.depth(time) : u > 0 && u0 > 0 ? std::min(h0 * u0 / u, 2 * h0) : h0;
    here.froude = u / std::sqrt(g * std::cos(zeta) * here.depth);
    line.push_back(here);

    const double middle = surface.angle(here.x + step / 2);
    const double squared = u * u + 2 * g * (std::sin(middle) - mu * std::cos(middle)) * step;
    const double next = std::sqrt(std::max(0.0, squared));
    if (u + next <= 1e-9) break;
    time += 2 * step / (u + next);
    u = next;
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
