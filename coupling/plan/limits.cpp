#include "coupling/plan/limits.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/plan/stiffness.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/refine.hpp"
#include "coupling/scene/release_shape.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

constexpr double most_grains = 1e9;
// Of the stable step, which is 0.16 of the Rayleigh time (hertz): beyond 0.2 contacts gain energy and walls feel wrong forces.
constexpr double longest_step = 1.25, shortest_step = 1e-3;
// [d] three quarters of the driven layer: what a face draws in must come from where grains stand ready.
constexpr double most_travel = 1.5;
constexpr double longest_skin = 3;  // [d] lists beyond it hold a hundred pairs a grain that do not touch

template <class... Args>
[[noreturn]] void fail(const Scene& scene, const std::string& key, fmt::format_string<Args...> text, Args&&... args) {
  throw SceneError(fmt::format("{}: {} {}", scene.places.of(key), key, fmt::format(text, std::forward<Args>(args)...)));
}

std::string us(double seconds) {
  return fmt::format("{:.4g} us", seconds * 1e6);
}

void check_step(const Scene& scene) {
  const double most = longest_step * stable_timestep(scene, expected_grain_density(scene));
  if (scene.grains.timestep > 0 && scene.grains.timestep < shortest_step * most) {
    fail(scene, "grains.timestep", "is {:.3g} us, less than {:.3g} us: a run would never end; leave it out",
         scene.grains.timestep * 1e6, shortest_step * most * 1e6);
  }
  if (scene.grains.timestep <= most) return;
  fail(scene, "grains.timestep", "is {}, too long for the smallest grain: at most {}, a {}; lower it, or leave it out",
       us(scene.grains.timestep), us(most),
       scene.grains.contact == "hertz" ? "fifth of its Rayleigh time" : "sixteenth of its contact time");
}

void check_skin(const Scene& scene) {
  const double most = longest_skin * scene.grains.diameter;
  if (scene.grains.skin <= most) return;
  fail(scene, "grains.skin", "is {:g} mm, more than three diameters, {:g} mm: lists would be long and runs slow; leave it out",
       1e3 * scene.grains.skin, 1e3 * most);
}

// [m/s] the fastest that material may get: each source's own speed, what the terrain can add to it, and its waves. Whatever the
// duration, and whether the estimate's flow gets there or not.
double fastest(const Scene& scene) {
  double gained = 0, most_gained = 0;  // [m2/s2] u^2 along the energy line, the best stretch of it
  const ReferenceSurface surface = reference_surface(scene);
  constexpr int stations = 400;
  const double length = scene.terrain.total_length(), step = length / stations, mu = closure_of(scene).tan_delta;
  for (int n = 0; n < stations; ++n) {
    const double zeta = surface.angle((n + 0.5) * step);
    gained = std::max(0.0, gained + 2 * scene.gravity * (std::sin(zeta) - mu * std::cos(zeta)) * step);
    most_gained = std::max(most_gained, gained);
  }
  const auto speed = [&](double start, double depth) {
    return std::sqrt(start * start + most_gained) + std::sqrt(scene.gravity * depth);
  };
  double most = 0;
  for (const FlowEstimate& f : flow_estimate(scene))
    most = std::max(most, std::abs(f.velocity) + std::sqrt(scene.gravity * f.depth));
  if (scene.release.speed() != 0) most = std::max(most, speed(scene.release.speed(), deepest(scene)));
  for (const SideSpec& side : scene.sides) {
    const GreatestInflow inflow = greatest_inflow(scene, side);
    if (inflow.depth > 0) most = std::max(most, speed(inflow.velocity, inflow.depth));
  }
  return most;
}

void check_window(const Scene& scene, const Plan& plan) {
  const double speed = fastest(scene), d = scene.grains.diameter, travel = speed * scene.grains.window * plan.engine_dt;
  if (travel <= most_travel * d) return;
  const double steps = std::floor(most_travel * d / (speed * plan.engine_dt));
  const std::string remedy = steps >= 1 ? fmt::format("use at most {:.0f} steps", steps)
                                        : std::string("even one is too long: use a slower flow or larger grains");
  fail(
      scene, "grains.window",
      "is {} engine steps of {}, in which the flow (up to {:.3g} m/s with its waves) goes {:.3g} grain diameters: at most {}; {}",
      scene.grains.window, us(plan.engine_dt), speed, travel / d, most_travel, remedy);
}

// On cell lines the zone may cut what the scene's own box held.
void check_zone(const Scene& scene, const Plan& plan) {
  const std::vector<ZoneBox>& boxes = scene.grains.zones;
  for (std::size_t n = 0; n < plan.zones.size(); ++n) {
    const PlannedZone& zone = plan.zones[n];
    if (layers_can_follow(scene, zone.cells)) continue;
    const double half = scene.terrain.width / 2;
    fail(scene, boxes.size() > 1 ? fmt::format("grains.zones[{}]", n) : "grains.zone",
         "{} a side along the slope, x from {:.6g} to {:.6g} m, beside a brink or more than one arc of the terrain, where its "
         "driven layer cannot follow the bed; make it as wide as the domain, y: [{:.6g} m, {:.6g} m]{}",
         boxes.empty() ? "is auto and would have" : "has", zone.box.x0, zone.box.x1, -half, half,
         boxes.empty() ? ", with that x" : ", or end it between the arcs");
  }
  for (const PlannedZone& zone : plan.zones)
    for (const ObstacleSpec& o : scene.obstacles) {
      const ZoneBox& z = zone.box;
      if (z.holds(o)) continue;
      if (scene.mode == Mode::grains)
        fail(scene, "obstacles." + o.name,
             "stands in the strip along a side through which material comes in, where a shallow flow brings it to the grains; "
             "they take over x from {:.6g} to {:.6g} m, y from {:.6g} to {:.6g} m; move it, or use smaller cells",
             z.x0, z.x1, z.y0, z.y1);
      if (z.apart(o)) continue;
      fail(scene, "grains.zone",
           "on the mesh's lines is x from {:.6g} to {:.6g} m, y from {:.6g} to {:.6g} m, which cuts through obstacles.{}; widen "
           "it by a cell, or use smaller cells",
           z.x0, z.x1, z.y0, z.y1, o.name);
    }
}

// Neighbours across a periodic side keep within one level of each other only where both end with a whole block.
void check_blocks(const Scene& scene, const Plan& plan) {
  if (scene.continuum.scheme == "noc" || !scene.continuum.refined()) return;
  const int edge = block_edge(scene), least = solver_settings(scene).refinement.levels();
  const int cells[] = {plan.grid.nx, plan.grid.ny};
  for (int axis : {0, 1}) {
    const bool periodic = scene.sides[2 * axis].kind == SideSpec::Kind::periodic;
    if (!periodic || cells[axis] % edge == 0) continue;
    int good = edge;
    while (good >= 4 && (cells[axis] % good != 0 || good % (1 << least) != 0)) --good;
    const std::string remedy = good >= 4 ? fmt::format("continuum.block: {} would do", good)
                                         : fmt::format("choose the cells so that there are {}", (cells[axis] / edge + 1) * edge);
    fail(scene,
         scene.continuum.block > 0        ? "continuum.block"
         : scene.continuum.refine.empty() ? "continuum.adapt"
                                          : "continuum.refine",
         "cuts blocks of {} x {} cells, of which {} cells between periodic sides are no whole number; {}", edge, edge,
         cells[axis], remedy);
  }
}

}  // namespace

void check_limits(const Scene& scene, const Plan& plan) {
  if (scene.mode != Mode::grains) check_blocks(scene, plan);
  if (scene.mode == Mode::continuum) return;
  check_step(scene);
  check_skin(scene);
  check_window(scene, plan);
  check_zone(scene, plan);
  const auto grains = double(plan.grains[std::size_t(scene.mode)]);
  if (grains > most_grains) {
    fail(scene, "grains.diameter", "is {}, which makes about {:.2g} grains; at most {:.0e}: use larger grains",
         short_quantity(scene.grains.diameter, Dimension::length), grains, most_grains);
  }
}

double machine_memory() {
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
}

void check_memory(const Scene& scene, const Plan& plan, int ranks) {
  if (ranks * plan.memory <= machine_memory()) return;
  const bool by_grains = scene.mode != Mode::continuum;
  fail(scene, by_grains ? "grains.diameter" : "continuum.cell",
       "asks for about {:.3g} GB of memory{}, and this machine has {:.3g} GB; use larger {}{}", plan.memory * 1e-9,
       ranks > 1 ? fmt::format(" on each of {} ranks", ranks) : "", machine_memory() * 1e-9, by_grains ? "grains" : "cells",
       ranks > 1 ? ", or fewer ranks" : "");
}

}  // namespace couloir
