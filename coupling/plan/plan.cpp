#include "coupling/plan/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuum/isa/isa.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/effects.hpp"
#include "coupling/plan/limits.hpp"
#include "coupling/plan/release.hpp"
#include "coupling/plan/stiffness.hpp"
#include "coupling/plan/switches.hpp"
#include "coupling/scene/calibration_name.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/refine.hpp"
#include "coupling/scene/stress_gauge.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

// Speeds of one core of about 2024, measured in whole runs of 1e5 to 2e6 cells, records included. Grains: LIGGGHTS made 2.0
// to 3.7 million particle-steps, YADE 0.5 to 0.8; two ranks gave 1.7 times one.
constexpr double cell_updates_per_second = 3e7, noc_updates_per_second = 1.5e7, liggghts_per_second = 2.5e6,
                 yade_per_second = 0.6e6, rank_exponent = 0.77;
constexpr double bytes_per_cell = 240, noc_bytes_per_cell = 700, bytes_per_grain = 2000;

// [d] of a stress gauge's width: on fewer grains its stresses are those of single contacts.
constexpr double few_grains = 5;

std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

// [s] the least step on the way: fastest wave (greatest K) of the release and of the flow downstream.
double least_step(const Scene& scene, const Grid& grid) {
  const EarthPressure k = closure_of(scene).earth_pressure;
  const double most_k = std::max({1.0, k.x_active, k.x_passive, k.y_passive_passive, k.y_passive_active});
  double fastest = 0;
  for (const FlowEstimate& f : flow_estimate(scene)) {
    if (f.time > scene.duration) break;
    fastest =
        std::max(fastest, std::hypot(f.velocity, scene.release.velocity_across) + std::sqrt(most_k * scene.gravity * f.depth));
  }
  const double half_steps = scene.continuum.scheme == "noc" ? 2 : 1;  // a step of noc is a pair, each bound by the CFL number
  return half_steps * scene.continuum.cfl * std::min(grid.dx, grid.dy) / fastest;
}

// Counts beyond all bounds stay countable.
std::int64_t whole(double count) {
  return static_cast<std::int64_t>(std::ceil(std::min(count, 1e18)));
}

std::int64_t grains_in(const Scene& scene, double volume) {
  return whole(volume * expected_solid_fraction / mean_grain_volume(scene.grains));
}

double volume_of_all_grains(const Scene& scene) {
  double volume = release_volume(scene);
  if (scene.fed()) {
    double deepest_inflow = 0, entered = 0;
    for (const SideSpec& side : scene.sides) {
      deepest_inflow = std::max(deepest_inflow, greatest_inflow(scene, side).depth);
      entered += inflow_volume(scene, side) * scene.terrain.width;
    }
    const double full = scene.terrain.total_length() * scene.terrain.width * deepest_inflow;
    volume = std::max(volume, std::min(volume + entered, full));
  }
  return volume;
}

// The zone filled to the expected depth, its driven layer, and a wedge of 1.5 to 1 before each obstacle.
double volume_in_zone(const Scene& scene, const ZoneBox& zone, const FlowEstimate& flow) {
  const double across = zone.y1 - zone.y0;
  double volume = flow.depth * across * (zone.x1 - zone.x0 + 3 * scene.grains.diameter);
  for (const ObstacleSpec& o : scene.obstacles)
    if (!zone.apart(o)) volume += 0.75 * o.height * o.height * o.width;
  return scene.fed() ? volume : std::min(volume, release_volume(scene));
}

// An obstacle that the flow will not meet is seldom meant.
void warn_of_absence(const Plan& plan, const Scene& scene, const auto& say) {
  if (scene.obstacles.empty()) return;
  const ObstacleSpec& first = *std::ranges::min_element(scene.obstacles, {}, &ObstacleSpec::x);
  const auto line = flow_estimate(scene);
  const double station = line.size() > 1 ? line[1].x - line[0].x : 0;
  if (line.back().x + 2 * station < first.x) {
    say(fmt::format("The middle of the flow is expected to stop {} before {}.", len(first.x - line.back().x), first.name));
  } else if (plan.at_obstacle.time > scene.duration) {
    say(fmt::format("The middle of the flow is expected at {} after {:.3g} s, later than the run ends.", first.name,
                    plan.at_obstacle.time));
  }
}

// Each gauge with what it will read.
void list_stress_gauges(Plan& plan, const Scene& scene) {
  for (const StressGaugeSpec& g : scene.stress_gauges) {
    const ObstacleSpec& o = scene.obstacles[static_cast<std::size_t>(g.obstacle)];
    const std::string name = o.name + "." + g.name;
    if (scene.mode == Mode::continuum) {
      plan.stress_gauges.push_back(
          name + ": records nothing in mode continuum: a depth-averaged flow has no stress on a part of a face");
      continue;
    }
    if (scene.mode == Mode::coupled && !any_holds(plan.zones, o)) {
      plan.stress_gauges.push_back(fmt::format("{}: records nothing, since {} lies outside the zone of grains", name, o.name));
      continue;
    }
    const GaugeBox b = gauge_box(g);
    const double least = std::min(b.right - b.left, b.high - b.low), d = scene.grains.diameter;
    const std::string shape =
        g.radius > 0 ? fmt::format("round, {} across", len(2 * g.radius)) : fmt::format("{} by {}", len(g.width), len(g.height));
    plan.stress_gauges.push_back(
        fmt::format("{}: {}, {:.1f} grains wide: normal stress, shear up and across", name, shape, least / d));
    if (least < few_grains * d)
      plan.warnings.push_back(
          fmt::format("Gauge {} is only {:.1f} grains wide: single contacts will show in its stresses.", name, least / d));
  }
}

// What a side can prescribe: all of a flow that outruns its waves, less of a slower one.
void warn_of_inflows(const Scene& scene, const auto& say) {
  const char* names[] = {"upstream", "downstream", "left", "right"};
  for (int side = 0; side < 4; ++side) {
    if (scene.sides[side].kind != SideSpec::Kind::inflow) continue;
    const GreatestInflow q = greatest_inflow(scene, scene.sides[side]);
    const double slope = reference_surface(scene).angle(side == 1 ? scene.terrain.total_length() : 0);
    const double froude = q.velocity / std::sqrt(scene.gravity * std::cos(slope) * q.depth);
    if (froude < 1) {
      say(fmt::format(
          "The inflow {} is slower than its waves (Froude {:.2f}): depth times velocity enters as stated, at the depth "
          "of the flow inside.",
          names[side], froude));
    }
  }
}

// Signs that nothing in this scene can give are none.
void warn_of_no_sign(const Scene& scene, const auto& say) {
  const AdaptSpec& a = scene.continuum.adapt;
  const bool some =
      a.front || a.gradient > 0 || (a.obstacle > 0 && !scene.obstacles.empty()) || (a.zone && scene.mode == Mode::coupled);
  if (scene.mode == Mode::grains || a.levels == 0 || some) return;
  say("continuum.adapt asks for finer cells by no sign that this scene has: none will be made; switch on front, gradient or "
      "obstacle, "
      "or leave adapt out.");
}

void warn_of_zone(const Scene& scene, const PlannedZone& zone, const auto& say) {
  const ZoneBox& z = zone.box;
  const double d = scene.grains.diameter;
  for (const ObstacleSpec& o : scene.obstacles) {
    const double before = o.x - z.x0;
    if (z.holds(o) && before < 20 * d && zone.lines.at_x == 0) {
      say(fmt::format("The zone reaches only {:.0f} grain diameters upstream of {}; the pile will reach its face.", before / d,
                      o.name));
    }
  }
  for (int side : {2, 3})
    if (scene.sides[side].kind == SideSpec::Kind::inflow)
      say("Flow that comes in from the side meets the zone obliquely: where it is steeper than 1 to 2 it is kept out as by a "
          "wall.");
  const double froude = flow_estimate_at(scene, z.x1).froude;
  if (froude > 0 && froude < 1) {
    say(fmt::format(
        "The flow is expected to leave the zone at Fr {:.2g}, below 1: what happens at the exit acts back on the zone.", froude));
  }
}

// Grain parameters of the scene's own that its calibration does not know of, or its contact law.
void warn_of_hand_set(const Scene& scene, const auto& say) {
  const auto set = [&](const std::vector<std::string>& names) {
    std::vector<std::string> out;
    for (const std::string& name : names)
      if (scene.places.has("grains." + name)) out.push_back("grains." + name);
    return out;
  };
  const auto rolling = set({"rolling_friction", "base_rolling_friction"});
  if (scene.grains.contact == "kelvin_voigt" && !rolling.empty())
    say(fmt::format("{} has no effect: contact kelvin_voigt has no rolling friction.", fmt::join(rolling, ", ")));
  const auto other = set({"friction", "rolling_friction", "base_friction", "base_rolling_friction", "restitution",
                          "youngs_modulus", "poisson_ratio"});
  if (!scene.material.calibration.empty() && !other.empty())
    say(fmt::format("The scene sets {} itself: the angles of the record {} are not those of these grains.",
                    fmt::join(other, ", "), scene.material.calibration));
}

void warn_of_impacts(const Plan& plan, const Scene& scene, const auto& say) {
  constexpr double soft = 0.3;  // [d]
  if (plan.bunch_overlap <= soft) return;
  Scene stiffer = scene;
  stiffer.material.grain.youngs_modulus = 0;
  say(fmt::format(
      "Grains in a bunch at {:.3g} m/s overlap by about {:.2g} of a diameter when they are stopped: they are too soft for that; "
      "raise grains.youngs_modulus (auto would take {}; their time step follows).",
      plan.impact_speed, plan.bunch_overlap, short_quantity(youngs_modulus(stiffer), Dimension::pressure)));
}

// Grains where they are not called for, and none where there is an obstacle.
void warn_of_places(const Plan& plan, const Scene& scene, const auto& say) {
  const bool fails = std::ranges::any_of(plan.shallow, [](const ShallowVerdict& v) { return v.obstacle && !v.holds(); });
  if (scene.grains.zones.empty() && !fails)
    say("The shallow model holds at every obstacle: mode continuum would do. The zones are around all of them.");
  for (const ObstacleSpec& o : scene.obstacles) {
    if (any_holds(plan.zones, o)) continue;
    const auto holds =
        std::ranges::any_of(plan.shallow, [&](const ShallowVerdict& v) { return v.obstacle && v.place == o.name && v.holds(); });
    say(fmt::format("{} lies outside the zone: the continuum flows around it{}.", o.name,
                    holds ? ", as the shallow model holds there" : ""));
  }
}

void warn(Plan& plan, const Scene& scene) {
  const auto say = [&](std::string text) { plan.warnings.push_back(std::move(text)); };
  warn_of_absence(plan, scene, say);
  warn_of_inflows(scene, say);
  warn_of_no_sign(scene, say);
  for (const std::string& assumed : inflow_assumptions(scene)) say(assumed);
  if (plan.memory > machine_memory())
    say(fmt::format("This machine has {:.3g} GB: the run would be refused.", machine_memory() * 1e-9));
  if (scene.mode == Mode::continuum && scene.grains.replicates > 1)
    say(fmt::format("grains.replicates is {}, but nothing in mode continuum is random: there is one run.",
                    scene.grains.replicates));
  if (scene.mode == Mode::continuum) return;
  const double d = scene.grains.diameter, tan_delta = closure_of(scene).tan_delta, mu = scene.material.grain.base_friction;
  if (scene.mode == Mode::coupled && std::abs(mu - tan_delta) > 0.02) {
    say(fmt::format("The two models brake differently: base friction of the grains is {:.3g}, tan(delta) is {:.3g}.", mu,
                    tan_delta));
  }
  const GrainSpec& g = scene.grains;
  if (const double rolling = scene.material.grain.rolling_friction; mu > 0.4 && rolling < 0.4 && g.rotation == "free") {
    say(fmt::format(
        "Base friction {:.3g} is above 0.4 and the rolling friction between grains, {:.3g}, below 0.4: the lowest grains "
        "roll then, and their friction is less sharp than Coulomb's.",
        mu, rolling));
  }
  const Material& m = scene.material;
  if (const std::string own =
          calibration_name(m.name, g.engine, contact_name(contact_law(g.contact), g.tangential_damping), rotation_name(g), d);
      !m.calibration.empty() && m.calibration != own) {
    say(
        fmt::format("The material's frictions are of the record {}, these grains would be {}: they may show other angles "
                    "(docs/calibration.md).",
                    m.calibration, own));
  }
  warn_of_hand_set(scene, say);
  warn_of_impacts(plan, scene, say);
  if (plan.at_obstacle.depth < 3 * d) {
    say(fmt::format("The flow at the {} is expected to be {:.3g} mm deep, less than three grains of {}.",
                    scene.obstacles.empty() ? "terrain's end" : "obstacle", plan.at_obstacle.depth * 1e3, len(d)));
  }
  const auto grains = plan.grains[static_cast<std::size_t>(scene.mode)];
  if (grains > 200000) say(fmt::format("About {} grains at once will be slow; larger grains or a smaller zone help.", grains));
  if (scene.mode == Mode::coupled) warn_of_places(plan, scene, say);
  for (const PlannedZone& zone : plan.zones) warn_of_zone(scene, zone, say);
}

}  // namespace

Plan make_plan(const Scene& asked) {
  const Scene scene = as_run(asked);
  Plan plan;
  plan.warnings = switched_off(asked);
  plan.title = scene.title;
  plan.mode = scene.mode;
  plan.effects = effects_of(asked);
  plan.release_volume = release_volume(scene);
  plan.release_mass = plan.release_volume * scene.material.density;
  const double first =
      scene.obstacles.empty() ? scene.terrain.total_length() : std::ranges::min_element(scene.obstacles, {}, &ObstacleSpec::x)->x;
  plan.at_obstacle = flow_estimate_at(scene, first);
  plan.impacts = impact_estimates(scene);
  plan.run_out = run_out(flow_estimate(scene)).value_or(std::numeric_limits<double>::quiet_NaN());

  if (scene.mode != Mode::grains) {
    plan.grid = grid_of(scene);
    plan.scheme = scene.continuum.scheme;
    plan.limiter = scene.continuum.limiter;
    plan.instruction_set = to_string(chosen_isa());
    plan.cells = static_cast<std::int64_t>(plan.grid.nx) * plan.grid.ny;
    plan.levels = planned_levels(scene);
    plan.followed_levels = scene.continuum.adapt.levels;
    if (!plan.levels.empty()) plan.cells = 0;
    for (const LevelCells& l : plan.levels) plan.cells += l.cells;
    if (plan.followed_levels > 0) plan.followed_cells = std::max(plan.cells, whole(estimated_cells(scene)));
    plan.dt = least_step(scene, plan.grid);
    plan.steps = whole(scene.duration / plan.dt);
    plan.memory += (plan.scheme == "noc" ? noc_bytes_per_cell : bytes_per_cell) *
                   static_cast<double>(std::max(plan.cells, plan.followed_cells));
    plan.time_continuum = 2.0 * static_cast<double>(plan.steps) * cells_by_work(scene) /
                          (plan.scheme == "noc" ? noc_updates_per_second : cell_updates_per_second);
  }

  plan.shallow = shallow_verdicts(scene);
  if (has_zones(scene)) plan.zones = planned_zones(scene);
  const bool zone_known = scene.continuum.cell > 0 && (!scene.grains.zones.empty() || !scene.obstacles.empty());
  if (scene.grains.diameter > 0) {
    plan.grains[static_cast<std::size_t>(Mode::grains)] = grains_in(scene, volume_of_all_grains(scene));
    if (zone_known) {
      double volume = 0;
      Scene coupled = scene;
      coupled.mode = Mode::coupled;
      for (const PlannedZone& zone : planned_zones(coupled)) volume += volume_in_zone(scene, zone.box, plan.at_obstacle);
      if (!scene.fed()) volume = std::min(volume, release_volume(scene));
      plan.grains[static_cast<std::size_t>(Mode::coupled)] = grains_in(scene, volume);
    }
  }

  if (scene.mode != Mode::continuum) {
    const auto count = static_cast<double>(plan.grains[static_cast<std::size_t>(scene.mode)]);
    plan.youngs_modulus = youngs_modulus(scene), plan.impact_speed = impact_speed(scene);
    plan.bunch_overlap = bunch_overlap(scene, plan.impact_speed);
    plan.engine_dt = engine_timestep(scene, expected_grain_density(scene));
    // Coupled: no engine before the flow nears the zone.
    const double idle = !plan.zones.empty() && !scene.fed() ? flow_estimate_at(scene, plan.zones.front().box.x0).time / 2 : 0;
    plan.engine_steps = whole(std::max(0.0, scene.duration - idle) / plan.engine_dt);
    plan.memory += bytes_of_engine * scene.grains.ranks + bytes_per_grain * count;
    const double rate = scene.grains.engine == "yade" ? yade_per_second : liggghts_per_second;
    plan.time_engine = count * static_cast<double>(plan.engine_steps) / (rate * std::pow(scene.grains.ranks, rank_exponent));
  }
  plan.time = plan.time_continuum + plan.time_engine;
  if (scene.mode != Mode::continuum) plan.replicates = scene.grains.replicates;
  list_stress_gauges(plan, scene);
  check_limits(scene, plan);
  warn(plan, scene);
  return plan;
}

}  // namespace couloir
