#include "coupling/plan/effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/plan/flow_estimate.hpp"
#include "coupling/plan/switches.hpp"
#include "coupling/plan/zone.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/refine.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

std::string ang(double value) {
  return short_quantity(value, Dimension::angle);
}
std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

struct Listing {
  const Scene& s;
  bool continuum = s.mode != Mode::grains;
  bool grains = s.mode != Mode::continuum;
  bool coupled = s.mode == Mode::coupled;
  bool flat = s.terrain.level();
  std::vector<TerrainArc> arcs = s.terrain.arcs();
  std::vector<PlannedZone> zones = coupled ? planned_zones(s) : std::vector<PlannedZone>{};
  std::string mode = fmt::format("mode is {}", to_string(s.mode));

  Effect depth_averaged_flow() const {
    if (feeds_grains_alone(s)) return {"depth_averaged_flow", true, mode + ": on the strip that brings the inflow, nowhere else"};
    return {"depth_averaged_flow", continuum, continuum ? mode : mode + ": grains carry the whole flow"};
  }

  Effect across_slope() const {
    if (!continuum) return {"across_slope", true, mode + ": grains move in all directions"};
    const int rows = grid_of(s).ny;
    if (rows == 1) return {"across_slope", false, "the domain is one row of cells: the 1D model (2.2), (2.11)"};
    return {"across_slope", true, fmt::format("the domain has {} rows of cells: the 2D model (2.87)-(2.92)", rows)};
  }

  Effect refinement() const {
    const ContinuumSpec& c = s.continuum;
    if (!continuum) return {"refinement", false, mode + ": there are no cells to refine"};
    if (!c.refined()) return {"refinement", false, "all cells are of one size: neither continuum.refine nor continuum.adapt"};
    const auto finest = [&](int levels) { return len(std::ldexp(grid_of(s).dx, -levels)); };
    std::vector<std::string> parts;
    for (const RefineSpec& r : c.refine) {
      const RefineRectangle b = within_domain(s, refine_rectangle(s, r));
      const std::string where = r.around.empty() ? "" : fmt::format("about {}, ", r.around);
      parts.push_back(fmt::format("{}x {} to {}, y {} to {}: {} level{}, cells of {}", where, len(b.x0), len(b.x1), len(b.y0),
                                  len(b.y1), r.levels, r.levels == 1 ? "" : "s", finest(r.levels)));
    }
    if (c.adapt.levels > 0) {
      const AdaptSpec& a = c.adapt;
      std::vector<std::string> signs;
      if (a.front) signs.push_back("fronts");
      if (a.gradient > 0) signs.push_back(fmt::format("changes of the surface above {:g} of the greatest depth", a.gradient));
      if (a.obstacle > 0) signs.push_back(fmt::format("{} about obstacles", len(a.obstacle)));
      if (a.zone && coupled) signs.push_back("the zone's rim");
      const std::string asked = signs.empty() ? "no sign is on" : fmt::format("{}", fmt::join(signs, ", "));
      parts.push_back(fmt::format("where the flow asks ({}): up to {} level{}, cells of {}", asked, a.levels,
                                  a.levels == 1 ? "" : "s", finest(a.levels)));
    }
    const char* how = c.scheme == "noc" ? "nested grids, copied" : "blocks that share their fluxes";
    return {"refinement", true, fmt::format("{}: {}", how, fmt::join(parts, "; "))};
  }

  Effect gravity_along_slope() const {
    return {"gravity_along_slope", !flat,
            flat                                           ? "the terrain is level"
            : s.terrain.kind == TerrainSpec::Kind::profile ? "the terrain's profile has a slope"
                                                           : fmt::format("the terrain is inclined by {}", ang(s.terrain.angle))};
  }

  Effect earth_pressure() const {
    if (!continuum) return {"earth_pressure", false, mode + ": stresses come from the contacts"};
    if (s.continuum.closure == "hydraulic") return {"earth_pressure", false, "closure is hydraulic: K = 1"};
    const EarthPressure k = closure_of(s).earth_pressure;
    if (k.is_hydraulic()) return {"earth_pressure", false, "closure is active_passive, but phi is 0, which gives K = 1"};
    return {"earth_pressure", true,
            fmt::format("closure is active_passive: phi {} and delta {} give K_act {:.5f}, K_pas {:.5f}", ang(s.material.phi),
                        ang(s.material.delta), k.x_active, k.x_passive)};
  }

  Effect basal_friction() const {
    if (!continuum) return {"basal_friction", false, mode + ": the bed brakes through the grains' own contacts"};
    const bool on = closure_of(s).tan_delta > 0;
    return {"basal_friction", on,
            on ? fmt::format("Coulomb, delta {}", ang(s.material.delta)) : "delta is 0: a frictionless bed"};
  }

  Effect curvature() const {
    if (!continuum) return {"curvature", false, mode + ": the grains move on the curved bed itself"};
    if (arcs.empty()) return {"curvature", false, "the terrain has no arc: kappa is 0 everywhere"};
    if (s.continuum.curvature == "off")
      return {"curvature", false, "continuum.curvature is off, although the terrain has an arc"};
    if (s.leaves_out("basal_friction"))
      return {"curvature", false, "it is a part of the friction, which is switched off by hand"};
    if (s.material.delta == 0) return {"curvature", false, "it presses the flow onto its bed, which is frictionless: delta is 0"};
    const TerrainArc& tightest = *std::ranges::max_element(arcs, {}, [](const TerrainArc& a) { return std::abs(a.curvature()); });
    return {"curvature", true,
            fmt::format("the terrain has {} of {} with radius {}", arcs.size() == 1 ? "an arc" : "arcs, the tightest",
                        len(tightest.length), len(1 / std::abs(tightest.curvature())))};
  }

  // Grains carry the flow around it.
  bool among_grains(const ObstacleSpec& o) const { return !continuum || any_holds(zones, o); }

  static std::string body(const ObstacleSpec& o) {
    if (o.shape != ObstacleSpec::Shape::mesh) return fmt::format("{} ({} high)", o.name, len(o.height));
    return fmt::format("{} ({} triangles{}{}, {} high)", o.name, o.faces.size(), o.file.empty() ? "" : " of ", o.file,
                       len(o.height));
  }

  // The obstacles that the continuum meets by this method.
  std::vector<std::string> bodies(ObstacleSpec::Method method) const {
    std::vector<std::string> names;
    for (const ObstacleSpec& o : s.obstacles) {
      if (o.method != method || among_grains(o)) continue;
      const bool of_planes = method == ObstacleSpec::Method::planes;
      names.push_back(body(o) + (of_planes ? fmt::format(", eta {:g}", o.eta) : ""));
    }
    return names;
  }

  // Each obstacle is in one of the four effects: what its method says, or solid where grains carry the flow around it.
  Effect by_method(const char* name, ObstacleSpec::Method method, const char* how, const char* none) const {
    const auto names = bodies(method);
    if (!names.empty()) return {name, true, fmt::format("{}: {}", how, fmt::join(names, ", "))};
    const bool given = std::ranges::any_of(s.obstacles, [&](const ObstacleSpec& o) { return o.method == method; });
    if (!given) return {name, false, none};
    return {name, false,
            continuum ? "grains of the zone meet the obstacles as solid bodies"
                      : mode + ": grains meet the obstacles as solid bodies"};
  }

  Effect steps_of_the_bed() const {
    return by_method("steps_of_the_bed", ObstacleSpec::Method::step, "the bed jumps, nothing flows through",
                     "no obstacle is a step of the bed");
  }

  Effect elevation() const {
    return by_method("elevation", ObstacleSpec::Method::elevation, "bed heights of obstacles, (4.4)-(4.9)",
                     "no obstacle is an elevation of the bed");
  }

  Effect planes() const {
    return by_method("planes", ObstacleSpec::Method::planes, "flows of their own on five planes",
                     "no obstacle is made of planes");
  }

  Effect solid_bodies() const {
    std::vector<std::string> names;
    for (const ObstacleSpec& o : s.obstacles) {
      if (among_grains(o)) names.push_back(body(o));
    }
    if (!names.empty()) {
      const char* where = continuum ? "in the zone of grains" : "among the grains";
      return {"solid_bodies", true, fmt::format("{}: {}", where, fmt::join(names, ", "))};
    }
    if (s.obstacles.empty()) return {"solid_bodies", false, "the scene has no obstacles"};
    return {"solid_bodies", false, mode + ": no grains"};  // check_scene lets no zone without an obstacle through
  }

  Effect inflow() const {
    const char* sides[] = {"upstream", "downstream", "left", "right"};
    std::vector<std::string> all;
    for (int side = 0; side < 4; ++side) {
      const SideSpec& spec = s.sides[side];
      if (spec.kind != SideSpec::Kind::inflow) continue;
      const GreatestInflow q = greatest_inflow(s, spec);
      const char* silo = s.material.diameter > 0 ? " from a silo's gate (velocity by Beverloo's law: assumed)"
                                                 : " from a silo's gate (velocity by Beverloo's law with d = 0: assumed)";
      const char* how = spec.inflow == SideSpec::Inflow::silo         ? silo
                        : spec.inflow == SideSpec::Inflow::hydrograph ? " at most, by a hydrograph"
                                                                      : "";
      all.push_back(fmt::format("{}: {} deep at {:.6g} m/s{}", sides[side], len(q.depth), q.velocity, how));
    }
    if (all.empty()) return {"inflow", false, "no side of the domain is an inflow"};
    const char* strip =
        s.mode == Mode::grains ? "; a shallow flow on a strip along that side, four cells or more, then grains" : "";
    return {"inflow", true, fmt::format("{}{}", fmt::join(all, "; "), strip)};
  }

  Effect periodic() const {
    const bool along = s.sides[0].kind == SideSpec::Kind::periodic, across = s.sides[2].kind == SideSpec::Kind::periodic;
    const char* which = along && across ? "all sides are periodic"
                        : along         ? "upstream and downstream are periodic"
                                        : "left and right are periodic";
    return {"periodic_sides", along || across, along || across ? which : "no sides are periodic"};
  }

  Effect grain_engine() const {
    if (!grains) return {"grain_engine", false, mode + ": no engine is started"};
    return {"grain_engine", true,
            fmt::format("{}: {}, contact {}, grains of {}, {} rank{}", mode, s.grains.engine,
                        s.grains.contact + (s.grains.tangential_damping ? "" : " without tangential damping"),
                        len(s.grains.diameter), s.grains.ranks, s.grains.ranks == 1 ? "" : "s")};
  }

  Effect rolling_friction() const {
    const GrainMaterial& g = s.material.grain;
    if (!grains) return {"rolling_friction", false, mode + ": no grains"};
    if (s.grains.contact != "hertz")
      return {"rolling_friction", false, "grains.contact is " + s.grains.contact + ", which has none"};
    if (s.grains.rotation == "blocked") return {"rolling_friction", false, "grains.rotation is blocked: none rolls"};
    const bool on = g.rolling_friction > 0 || g.base_rolling_friction > 0;
    return {"rolling_friction", on,
            fmt::format("{:g} between grains, {:g} on surfaces", g.rolling_friction, g.base_rolling_friction)};
  }

  Effect rotation_control() const {
    if (!grains) return {"rotation_control", false, mode + ": no grains"};
    if (s.grains.rotation == "free") return {"rotation_control", false, "grains.rotation is free: contacts alone turn a grain"};
    if (s.grains.rotation == "blocked") return {"rotation_control", true, "grains.rotation is blocked: no grain turns"};
    const RotationSpec& c = s.grains.control;
    std::string how = fmt::format("(4.11), (4.12) with lambda_c {} and chi {:g}",
                                  short_quantity(c.retarding_time, Dimension::time), c.contact_influence);
    if (c.shear_influence > 0)
      how +=
          fmt::format("; longer in shear, (4.13) with k_v {}", short_quantity(c.shear_influence, Dimension::time_per_velocity));
    if (c.slide_to_roll > 0) {
      how +=
          fmt::format("; a grain without spin slides below {}, one with spin comes to slide below {}",
                      short_quantity(c.slide_to_roll, Dimension::velocity), short_quantity(c.roll_to_slide, Dimension::velocity));
    }
    return {"rotation_control", true, "grains.rotation has control: " + how};
  }

  Effect side_friction() const {
    if (!grains) return {"side_friction", false, mode + ": no grains"};
    const bool wall = s.sides[2].kind == SideSpec::Kind::wall || s.sides[3].kind == SideSpec::Kind::wall;
    if (!wall) return {"side_friction", false, "neither the left nor the right side is a wall"};
    const double mu = s.material.grain.side_friction;
    return {"side_friction", mu > 0, fmt::format("grains meet the side walls with friction {:g}", mu)};
  }

  Effect coupling() const {
    if (feeds_grains_alone(s)) return {"coupling", true, mode + ": the strip that brings the inflow hands it to the grains"};
    if (!coupled) return {"coupling", false, mode + ": one model alone"};
    return {"coupling", true,
            !s.grains.zones.empty() ? "mode is coupled, with the zone that the scene gives"
            : zones.size() == 1
                ? "mode is coupled, with an automatic zone around the obstacles"
                : fmt::format("mode is coupled, with {} automatic zones around the obstacles, an engine each", zones.size())};
  }

  Effect airborne() const {
    if (!coupled)
      return {"airborne", false, grains ? mode + ": grains fly as grains" : mode + ": a depth-averaged flow has no flight"};
    if (s.obstacles.empty()) return {"airborne", false, "no obstacle throws grains above the flow"};
    double least = 0;
    const ObstacleSpec* lowest = nullptr;
    for (const ObstacleSpec& o : s.obstacles) {
      const double spare = run_up(o) - o.height;
      if (!lowest || spare > least) least = spare, lowest = &o;
    }
    return {
        "airborne", true,
        fmt::format(
            "grains that leave a zone in the air, more than a diameter above the flow, fly on and become flow where they come "
            "down; the energy line reaches {} at {}, which is {} high",
            fmt::format("{:.3g} mm", run_up(*lowest) * 1e3), lowest->name, len(lowest->height))};
  }

  // Depth and velocity head of the flow expected at an obstacle.
  double run_up(const ObstacleSpec& o) const {
    const FlowEstimate flow = flow_estimate_at(s, o.x);
    return flow.depth + flow.velocity * flow.velocity / (2 * s.gravity * std::cos(reference_surface(s).angle(o.x)));
  }
};

std::vector<Effect> listed(const Scene& scene) {
  const Listing list{scene};
  return {list.depth_averaged_flow(),
          list.across_slope(),
          list.refinement(),
          list.gravity_along_slope(),
          list.earth_pressure(),
          list.basal_friction(),
          list.curvature(),
          list.steps_of_the_bed(),
          list.elevation(),
          list.planes(),
          list.solid_bodies(),
          list.inflow(),
          list.periodic(),
          list.grain_engine(),
          list.rolling_friction(),
          list.rotation_control(),
          list.side_friction(),
          list.coupling(),
          list.airborne()};
}

}  // namespace

std::vector<Effect> called_for(const Scene& scene) {
  Scene whole = scene;
  whole.left_out.clear();
  return listed(whole);
}

std::vector<Effect> effects_of(const Scene& scene) {
  if (scene.left_out.empty()) return listed(scene);
  std::vector<Effect> all = listed(as_run(scene));
  const std::vector<Effect> asked = called_for(scene);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!scene.leaves_out(all[k].name)) continue;
    all[k] = asked[k];
    if (asked[k].on) all[k] = {asked[k].name, false, "switched off by hand, although the scene calls for it: " + asked[k].reason};
  }
  return all;
}

}  // namespace couloir
