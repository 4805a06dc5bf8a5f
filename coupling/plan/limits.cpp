#include "coupling/plan/limits.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

constexpr double most_grains = 1e9;
// Of the stable step, which is 0.16 of the Rayleigh time: beyond 0.2 contacts gain energy and walls feel wrong forces.
constexpr double longest_step = 1.25;
// [d] half the driven layer of 3 d: what a face draws in must come from where grains stand ready.
constexpr double most_travel = 1.5;

template <class... Args>
[[noreturn]] void fail(const Scene& scene, const std::string& key, fmt::format_string<Args...> text, Args&&... args) {
  throw SceneError(fmt::format("{}: {} {}", scene.places.of(key), key, fmt::format(text, std::forward<Args>(args)...)));
}

std::string us(double seconds) {
  return fmt::format("{:.4g} us", seconds * 1e6);
}

void check_step(const Scene& scene) {
  const double most = longest_step * stable_timestep(scene, expected_grain_density(scene));
  if (scene.grains.timestep <= most) return;
  fail(scene, "grains.timestep",
       "is {}, too long for the smallest grain: at most {}, a fifth of its Rayleigh time; lower it, or leave it out",
       us(scene.grains.timestep), us(most));
}

void check_window(const Scene& scene, const Plan& plan) {
  double fastest = 0;
  for (const FlowEstimate& f : flow_estimate(scene)) {
    const double speed = std::abs(f.velocity) + std::sqrt(scene.gravity * f.depth);
    if (f.time <= scene.duration && speed > fastest) fastest = speed;
  }
  const double d = scene.grains.diameter, travel = fastest * scene.grains.window * plan.engine_dt;
  if (travel <= most_travel * d) return;
  fail(scene, "grains.window",
       "is {} engine steps of {}, in which the flow (up to {:.3g} m/s with its waves) goes {:.3g} grain diameters: at most {}; "
       "use at "
       "most {} steps",
       scene.grains.window, us(plan.engine_dt), fastest, travel / d, most_travel,
       std::max(1, int(most_travel * d / (fastest * plan.engine_dt))));
}

}  // namespace

void check_limits(const Scene& scene, const Plan& plan) {
  if (scene.mode == Mode::continuum) return;
  check_step(scene);
  check_window(scene, plan);
  const auto grains = double(plan.grains[std::size_t(scene.mode)]);
  if (grains > most_grains) {
    fail(scene, "grains.diameter", "is {}, which makes about {:.2g} grains; at most {:.0e}: use larger grains",
         short_quantity(scene.grains.diameter, Dimension::length), grains, most_grains);
  }
}

double machine_memory() {
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
}

void check_memory(const Scene& scene, const Plan& plan) {
  if (plan.memory <= machine_memory()) return;
  const bool by_grains = scene.mode != Mode::continuum;
  fail(scene, by_grains ? "grains.diameter" : "continuum.cell",
       "asks for about {:.3g} GB of memory, and this machine has {:.3g} GB; use larger {}", plan.memory * 1e-9,
       machine_memory() * 1e-9, by_grains ? "grains" : "cells");
}

}  // namespace couloir
