#include "coupling/scene/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/scene/bodies.hpp"
#include "coupling/scene/check_engine.hpp"
#include "coupling/scene/check_gauges.hpp"
#include "coupling/scene/check_mesh.hpp"
#include "coupling/scene/check_zones.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/release_shape.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

// Passive earth pressure beyond which the flow gains energy where a passive cell meets an active one (tests/stability); phi about
// 65 deg, which no granular material has.
constexpr double most_passive = 20;
// Depth over the arc's radius: at 1 the normals meet inside the flow; at 1/2 the volume above a piece of the bed, which the model
// takes for h, is h (1 - h / 2R), a quarter less.
constexpr double most_on_arc = 0.5;
constexpr double steepest = 89 * std::numbers::pi / 180 * (1 + 1e-9);  // whatever the last bit of 89 deg as typed

// LIGGGHTS's own bound, below which it warns; it refuses a mesh with angles somewhat smaller.
constexpr double thinnest_deg = 0.5, thinnest = thinnest_deg * std::numbers::pi / 180;

std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

struct Checker {
  const Scene& scene;

  template <class... Args>
  [[noreturn]] void fail(const std::string& key, fmt::format_string<Args...> text, Args&&... args) const {
    throw SceneError(fmt::format("{}: {} {}", scene.places.of(key), key, fmt::format(text, std::forward<Args>(args)...)));
  }

  bool continuum() const { return scene.mode != Mode::grains; }
  bool grains() const { return scene.mode != Mode::continuum; }
  double length() const { return scene.terrain.total_length(); }
  double width() const { return scene.terrain.width; }
  // Lengths are compared with a little room for round-off.
  double room() const { return 1e-9 * (length() + width()); }

  void material() const {
    const Material& m = scene.material;
    if (continuum() && scene.continuum.closure == "active_passive" && m.delta > m.phi) {
      fail("material.basal_friction_angle",
           "is {}, above the internal friction angle {}: (2.83) has no real K; lower it, or use continuum.closure: hydraulic",
           short_quantity(m.delta, Dimension::angle), short_quantity(m.phi, Dimension::angle));
    }
    if (!continuum() || scene.continuum.closure != "active_passive") return;
    const double c = std::cos(m.phi), ratio = c / std::cos(m.delta);
    const double passive = 2 * (1 + std::sqrt(std::max(0.0, 1 - ratio * ratio))) / (c * c) - 1;  // (2.83)
    if (passive > most_passive) {
      fail("material.internal_friction_angle",
           "is {}, which makes a passive earth pressure coefficient of {:.3g}: above {} the flow would gain energy; lower it, or "
           "use continuum.closure: hydraulic",
           short_quantity(m.phi, Dimension::angle), passive, most_passive);
    }
  }

  void curvature() const {
    if (!continuum()) return;
    double depth = deepest(scene);
    for (const SideSpec& side : scene.sides) {
      if (side.kind == SideSpec::Kind::inflow) depth = std::max(depth, greatest_inflow(scene, side).depth);
    }
    const Footprint f = release_footprint(scene);
    for (const TerrainArc& arc : scene.terrain.arcs()) {
      const double radius = 1 / std::abs(arc.curvature());
      const bool on_arc = f.x1 > arc.begin + room() && f.x0 < arc.begin + arc.length - room();
      if (arc.turn > 0 && depth >= radius) {
        const bool chute = scene.terrain.kind == TerrainSpec::Kind::chute;
        fail(chute ? "terrain.arc" : "terrain.profile",
             "{} {}, a radius of {}, no larger than the flow's greatest depth {}: depths are measured along normals, which meet "
             "inside such a flow; use a longer arc",
             chute ? "is" : fmt::format("has an arc at x = {} of", len(arc.begin)), len(arc.length), len(radius), len(depth));
      }
      if (on_arc && deepest(scene) > most_on_arc * radius) {
        fail("release",
             "is up to {} deep on an arc of radius {}: at most half of the radius, beyond which volumes on the arc are off "
             "by more than a quarter; move it up, or use a longer arc",
             len(deepest(scene)), len(radius));
      }
    }
  }

  void profile() const {
    if (scene.terrain.kind != TerrainSpec::Kind::profile) return;
    const auto& rows = scene.terrain.profile;
    const auto ang = [](double value) { return short_quantity(value, Dimension::angle); };
    if (rows.size() < 2) fail("terrain.profile", "has {} row; give at least 2", rows.size());
    if (rows.front().x != 0) fail("terrain.profile", "begins at {}; its first row must be at x = 0", len(rows.front().x));
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k > 0 && !(rows[k].x > rows[k - 1].x))
        fail("terrain.profile", "has a row at {} after one at {}; x must rise", len(rows[k].x), len(rows[k - 1].x));
      if (!(std::abs(rows[k].angle) <= steepest))
        fail("terrain.profile", "has an angle of {} at x = {}; give one from -89 to 89 deg", ang(rows[k].angle), len(rows[k].x));
    }
    const auto [least, most] = std::ranges::minmax(rows, {}, &ProfileRow::angle);
    if (most.angle - least.angle > std::numbers::pi / 2)
      fail("terrain.profile", "turns from {} to {}; a terrain's angles must lie within 90 deg of each other", ang(least.angle),
           ang(most.angle));
  }

  void sides() const {
    const char* names[] = {"upstream", "downstream", "left", "right"};
    using Kind = SideSpec::Kind;
    for (int low = 0; low < 4; low += 2) {
      const bool first = scene.sides[low].kind == Kind::periodic, second = scene.sides[low + 1].kind == Kind::periodic;
      if (first != second) {
        const int given = first ? low : low + 1, other = first ? low + 1 : low;
        fail(fmt::format("boundaries.{}", names[given]), "is periodic, but boundaries.{} is not; periodic sides come in pairs",
             names[other]);
      }
    }
    if (const bool chute = scene.terrain.kind == TerrainSpec::Kind::chute;
        scene.sides[0].kind == Kind::periodic && (chute || !scene.terrain.arcs().empty())) {
      fail("boundaries.upstream", "is periodic on a {}; use wall or outflow",
           chute ? "chute, whose ends have different slopes" : "profile with arcs");
    }
    for (int k = 0; k < 4; ++k) inflow(scene.sides[k], fmt::format("boundaries.{}.inflow", names[k]));
    if (scene.mode == Mode::continuum) return;
    if (scene.sides[0].kind == Kind::periodic) {
      fail("boundaries.upstream", "is periodic, which grains are across the slope only; use wall or outflow, or mode: continuum");
    }
  }

  void inflow(const SideSpec& side, const std::string& key) const {
    if (side.kind != SideSpec::Kind::inflow) return;
    if (side.inflow == SideSpec::Inflow::hydrograph) {
      if (side.hydrograph.size() < 2) fail(key + ".hydrograph", "has {} rows; give at least 2", side.hydrograph.size());
      for (std::size_t k = 1; k < side.hydrograph.size(); ++k) {
        if (!(side.hydrograph[k].time > side.hydrograph[k - 1].time))
          fail(key + ".hydrograph", "has a row at {} after one at {}; the times must rise",
               short_quantity(side.hydrograph[k].time, Dimension::time),
               short_quantity(side.hydrograph[k - 1].time, Dimension::time));
      }
      if (greatest_inflow(scene, side).velocity == 0 || greatest_inflow(scene, side).depth == 0)
        fail(key + ".hydrograph", "lets nothing in; give rows with a depth and a velocity");
    }
    if (side.inflow == SideSpec::Inflow::silo && greatest_inflow(scene, side).velocity == 0) {
      fail(key + ".gate", "is {}, too narrow for grains of {}: none would come through; open it further", len(side.gate),
           len(scene.material.diameter));
    }
  }

  void release() const {
    const ReleaseSpec& r = scene.release;
    if (r.kind == ReleaseSpec::Kind::none) {
      if (!scene.fed()) fail("release.kind", "is none, but no side is an inflow: there would be no material; give one of both");
      return;
    }
    if (r.kind == ReleaseSpec::Kind::uniform) return;
    if (r.kind == ReleaseSpec::Kind::cap && r.height > r.base_radius) {
      fail("release.height", "is {}, more than the base radius {}: the cap would overhang; lower it to a hemisphere at most",
           len(r.height), len(r.base_radius));
    }
    const Footprint f = release_footprint(scene);
    if (f.x0 < -room() || f.x1 > length() + room() || f.y0 < -width() / 2 - room() || f.y1 > width() / 2 + room()) {
      fail("release",
           "covers x from {} to {} and y from {} to {}, which reaches out of the domain (x from 0 to {}, y from {} to {})",
           len(f.x0), len(f.x1), len(f.y0), len(f.y1), len(length()), len(-width() / 2), len(width() / 2));
    }
  }

  void obstacles() const {
    for (std::size_t n = 0; n < scene.obstacles.size(); ++n) {
      obstacle(scene.obstacles[n]);
      for (std::size_t m = 0; m < n; ++m) apart(scene.obstacles[m], scene.obstacles[n]);
    }
  }

  void obstacle(const ObstacleSpec& o) const {
    const std::string key = "obstacles." + o.name;
    const double x1 = o.x + o.length, y0 = o.y - o.width / 2, y1 = o.y + o.width / 2;
    if (o.x < -room() || x1 > length() + room() || y0 < -width() / 2 - room() || y1 > width() / 2 + room()) {
      fail(key, "covers x from {} to {} and y from {} to {}, which reaches out of the domain (x from 0 to {}, y from {} to {})",
           len(o.x), len(x1), len(y0), len(y1), len(length()), len(-width() / 2), len(width() / 2));
    }
    const double gaps[] = {o.x, length() - x1, y0 + width() / 2, width() / 2 - y1};
    for (int side = 0; side < 4; ++side) {
      if (scene.sides[side].kind == SideSpec::Kind::inflow && gaps[side] < 0.5 * scene.continuum.cell)
        fail(key,
             "stands on a side through which material comes in, which would come in on top of it; move it by a cell at least");
    }
    if (o.shape == ObstacleSpec::Shape::tetrahedron) {
      if (o.method == ObstacleSpec::Method::step) {
        fail(key + ".method", "is step, but a tetrahedron has no upright sides; use elevation, or leave it out");
      }
      if (o.ramp > 0) fail(key + ".ramp", "belongs to a cuboid; a tetrahedron's faces are given by its size; leave it out");
    }
    const bool mesh = o.shape == ObstacleSpec::Shape::mesh;
    if (mesh && o.ramp > 0) fail(key + ".ramp", "belongs to a cuboid; a mesh has its own sides; leave it out");
    if (o.ramp > std::min(o.length, o.width) / 2 + room()) {
      fail(key + ".ramp", "is {}, more than half of the base's shorter edge ({}); shorten it", len(o.ramp),
           len(std::min(o.length, o.width)));
    }
    // The continuum alone may start on top of an obstacle: depths count from there.
    using Kind = ReleaseSpec::Kind;
    if (grains() && scene.release.kind != Kind::uniform && scene.release.kind != Kind::none && overlaps_release(o)) {
      fail(key, "stands in the release; move one of them");
    }
    const double cell = scene.continuum.cell;
    if (continuum() && cell > 0 && (o.length < 0.999 * cell || o.width < 0.999 * scene.continuum.across())) {
      fail(key + (mesh ? ".file" : ".size"),
           "is {} by {} on the bed, thinner than a cell ({}), so that the mesh would not see it; use smaller cells",
           len(o.length), len(o.width), len(cell));
    }
    if (mesh && grains() && scene.grains.diameter > 0) thin_triangles(o, key);
    if (o.method == ObstacleSpec::Method::planes) planes(o, key);
  }

  void thin_triangles(const ObstacleSpec& o, const std::string& key) const {
    const double angle = smallest_angle(cut_to_size(o.body->triangles(), longest_edge(scene.grains)));
    if (angle < thinnest) {
      fail(
          key + ".file",
          "has triangles with an angle of {:.2g} deg, so thin that the engine refuses them: at least {} deg; mesh the body anew, "
          "or use mode: continuum",
          angle / thinnest * thinnest_deg, thinnest_deg);
    }
  }

  // The one cuboid of five planes. Grains meet its solid body instead, so the method then has no say.
  void planes(const ObstacleSpec& o, const std::string& key) const {
    if (o.shape != ObstacleSpec::Shape::cuboid) fail(key + ".method", "is planes, which only a cuboid has; use elevation");
    if (scene.mode == Mode::grains) return;
    if (scene.mode == Mode::coupled) {
      const std::vector<ZoneBox>& boxes = scene.grains.zones;
      if (boxes.empty() || std::ranges::any_of(boxes, [&](const ZoneBox& z) { return z.holds(o); })) return;
      fail(key + ".method",
           "is planes, which mode coupled has only where grains hold the obstacle; enlarge grains.zone, or use step");
    }
    const auto planes = [](const ObstacleSpec& other) { return other.method == ObstacleSpec::Method::planes; };
    if (std::ranges::count_if(scene.obstacles, planes) > 1) {
      fail(key + ".method", "is planes, and so is that of another obstacle: one a scene; use step for the others");
    }
    if (scene.release.kind != ReleaseSpec::Kind::uniform && overlaps_release(o)) {
      fail(key, "stands in the release, where method planes cannot start; move one of them");
    }
    const double cell = scene.continuum.cell;
    if (o.x < 0.5 * cell) fail(key + ".position", "leaves no slope before the obstacle's front plane; move it down");
    const bool beside = o.y - o.width / 2 < -width() / 2 + 0.5 * cell || o.y + o.width / 2 > width() / 2 - 0.5 * cell;
    if (beside && scene.sides[2].kind == SideSpec::Kind::periodic) {
      fail(key + ".size", "reaches a periodic side, where planes cannot go on; make it narrower, or the sides walls");
    }
    if (o.x + o.length > length() - 0.5 * cell && scene.sides[1].kind == SideSpec::Kind::periodic) {
      fail(key + ".position", "reaches a periodic side, where planes cannot go on; move it up");
    }
  }

  bool overlaps_release(const ObstacleSpec& o) const {
    if (o.shape == ObstacleSpec::Shape::mesh) {
      return some_place(o, [&](double x, double y) { return o.covers(x, y) && shape_depth(scene, x, y) > 0; });
    }
    // The footprint's point nearest to the release's middle decides: all shapes are convex and symmetric about it.
    const Footprint f = release_footprint(scene);
    const double x = std::clamp((f.x0 + f.x1) / 2, o.x, o.x + o.length);
    const double y = std::clamp(scene.release.y, o.y - o.width / 2, o.y + o.width / 2);
    if (scene.release.kind == ReleaseSpec::Kind::block) {
      return o.x < f.x1 - room() && o.x + o.length > f.x0 + room() && o.y - o.width / 2 < f.y1 - room() &&
             o.y + o.width / 2 > f.y0 + room();
    }
    return shape_depth(scene, x, y) > 0;
  }

  // Whether it is so somewhere in the box around the obstacle, by a raster.
  template <class Is>
  static bool some_place(const ObstacleSpec& o, const Is& is) {
    constexpr int n = 256;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (is(o.x + (i + 0.5) / n * o.length, o.y + ((j + 0.5) / n - 0.5) * o.width)) return true;
    return false;
  }

  void apart(const ObstacleSpec& a, const ObstacleSpec& b) const {
    if (a.x < b.x + b.length - room() && b.x < a.x + a.length - room() &&
        std::abs(a.y - b.y) < (a.width + b.width) / 2 - room()) {
      // A body may stand in the box around another one.
      const bool boxes = a.shape == ObstacleSpec::Shape::cuboid && b.shape == ObstacleSpec::Shape::cuboid;
      const auto both = [&](double x, double y) { return a.covers(x, y) && b.covers(x, y); };
      if (!boxes && !some_place(a, both) && !some_place(b, both)) return;
      fail("obstacles." + b.name, "overlaps obstacles.{}; move one of them", a.name);
    }
  }

  void scheme() const {
    if (!continuum()) return;
    const bool noc = scene.continuum.scheme == "noc";
    if (!noc && scene.continuum.limiter == "eno") {
      fail("continuum.limiter", "is eno, which scheme central_upwind does not have; use scheme: noc, or another limiter");
    }
    if (noc && scene.mode == Mode::coupled) {
      fail("continuum.scheme",
           "is noc, which runs in mode continuum only: it has no zone for grains; use central_upwind, or mode: "
           "continuum");
    }
    for (const ObstacleSpec& o : scene.obstacles) {
      if (noc && o.method == ObstacleSpec::Method::step) {
        fail("obstacles." + o.name,
             "is a step of the bed, which scheme noc cannot have: it knows obstacles by the bed's slope alone; use method: "
             "elevation, or continuum.scheme: central_upwind");
      }
      if (noc && o.method == ObstacleSpec::Method::planes) {
        fail("obstacles." + o.name + ".method",
             "is planes, which scheme noc does not have; use continuum.scheme: central_upwind");
      }
    }
  }

  void diameter() const {
    if (!grains()) return;
    const double d = scene.grains.diameter;
    if (d == 0) {
      fail("grains.diameter",
           "is missing: mode {} needs a section grains with the diameter of a simulated grain; or use mode: continuum",
           to_string(scene.mode));
    }
    double depth = deepest(scene);
    for (const SideSpec& side : scene.sides) {
      depth = std::max(depth, greatest_inflow(scene, side).depth);
    }
    if (d * (1 + scene.grains.spread) > depth) {
      fail("grains.diameter", "is {}, and with its spread larger than the flow's greatest depth {}; use smaller grains", len(d),
           len(depth));
    }
    for (const ObstacleSpec& o : scene.obstacles) {
      if (d > std::min(o.height, o.width) / 2) {
        fail("grains.diameter", "is {}, too large for obstacles.{} ({} wide, {} high): at most half of the smaller", len(d),
             o.name, len(o.width), len(o.height));
      }
    }
    if (width() < 2 * d)
      fail("grains.diameter", "is {}, too large for a domain {} wide; use smaller grains", len(d), len(width()));
  }

  void records() const {
    constexpr double most_rows = 1e7;
    for (const auto& [key, interval] :
         {std::pair{"record.forces", scene.record.forces}, std::pair{"record.frames", scene.record.frames},
          std::pair{"record.checkpoint", checkpoint_interval(scene)}}) {
      if (scene.duration <= most_rows * interval) continue;
      const auto sec = [](double value) { return short_quantity(value, Dimension::time); };
      fail(key, "is {}, which makes more than ten million records in {}; use at least {}", sec(interval), sec(scene.duration),
           sec(scene.duration / most_rows));
    }
  }

  void gauges() const {
    for (const GaugeSpec& g : scene.record.gauges) {
      if (g.x < -room() || g.x + g.length > length() + room() || std::abs(g.y) + g.width / 2 > width() / 2 + room()) {
        const bool point = g.length == 0 && g.width == 0;
        const std::string size = point ? "" : fmt::format(" with size [{}, {}]", len(g.length), len(g.width));
        fail(fmt::format("record.gauges.{}.position", g.name),
             "is [{}, {}]{}, outside of the domain (x from 0 to {}, y from {} to {})", len(g.x), len(g.y), size, len(length()),
             len(-width() / 2), len(width() / 2));
      }
    }
  }
};

}  // namespace

void check_scene(const Scene& scene) {
  const Checker check{scene};
  check.profile();
  check.material();
  check.sides();
  check.release();
  check.scheme();
  check.curvature();
  check_mesh(scene);
  check.obstacles();
  check_refinement(scene);
  check.gauges();
  check.diameter();
  check_stress_gauges(scene);
  check_engine(scene);
  check_zones(scene);
  check.records();
}

}  // namespace couloir
