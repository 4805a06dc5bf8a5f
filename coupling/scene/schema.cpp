#include "coupling/scene/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "coupling/scene/effect_names.hpp"
#include "coupling/scene/schema_builder.hpp"

namespace couloir {
namespace {

using enum Dimension;
using namespace schema_builder;

constexpr double steepest = 89 * deg * (1 + 1e-9);  // 89 deg as typed is within it, whatever its last bit

// `s.member` for a const and for a mutable Scene alike.
#define COULOIR_AT(member)                       \
  [](auto& s, [[maybe_unused]] int i) -> auto& { \
    return s.member;                             \
  }

void add_run(Keys& k) {
  k.add(text("title", "what the run is about, in one line", COULOIR_AT(title)));
  k.add(choice("mode", "which models run", {"continuum", "coupled", "grains"}, COULOIR_AT(mode)));
  k.add(number("gravity", acceleration, "gravitational acceleration", COULOIR_AT(gravity)).above(0));
  k.add(mapping("scales", "bare numbers are multiples of the scales (2.47) that these set; angles still need units").unwritten());
  k.add(own_number("scales.length", length, "the length L; time sqrt(L/g), velocity sqrt(L g), mass density L^3")
            .above(0)
            .required());
}

void add_terrain(Keys& k) {
  k.add(mapping("terrain", "the reference surface; x runs down it from the upper edge, y across it from the centre line")
            .required());
  k.add(choice("terrain.kind", "its shape", {"flat", "incline", "chute", "profile"}, COULOIR_AT(terrain.kind)).required());
  k.add(number("terrain.angle", angle, "inclination of the incline", COULOIR_AT(terrain.angle))
            .within(0, steepest)
            .required()
            .when("kind", {"incline", "chute"}));
  k.add(number("terrain.length", length, "along the surface", COULOIR_AT(terrain.length))
            .above(0)
            .required()
            .when("kind", {"flat", "incline"}));
  k.add(number("terrain.slope", length, "of the incline, along the surface", COULOIR_AT(terrain.slope))
            .above(0)
            .required()
            .when("kind", {"chute"}));
  k.add(number("terrain.arc", length, "of the arc between incline and run-out, along the surface", COULOIR_AT(terrain.arc))
            .above(0)
            .required()
            .when("kind", {"chute"}));
  k.add(number("terrain.runout", length, "of the level run-out", COULOIR_AT(terrain.runout))
            .above(0)
            .required()
            .when("kind", {"chute"}));
  Key profile;
  profile.path = "terrain.profile";
  profile.kind = ValueKind::table;
  profile.help =
      "rows [x, angle] from the upper edge, x = 0, to the lower one, x along the surface; the angle is linear between them, so "
      "that "
      "rows of different angles have an arc between them; negative: uphill";
  profile.columns = {length, angle};
  profile.column_names = {"x", "angle"};
  profile.presence = Presence::required;
  profile.selector = "kind";
  profile.selected = {"profile"};
  profile.get = [](const Scene& s, int) -> Value {
    std::vector<double> out;
    for (const ProfileRow& row : s.terrain.profile) out.insert(out.end(), {row.x, row.angle});
    return out;
  };
  profile.set = [](Scene& s, int, const Value& value) {
    const auto& list = std::get<std::vector<double>>(value);
    s.terrain.profile.clear();
    for (std::size_t n = 0; n + 1 < list.size(); n += 2) s.terrain.profile.push_back({list[n], list[n + 1]});
  };
  k.add(profile);
  k.add(
      number("terrain.width", length, "across; y runs from -width/2 to width/2", COULOIR_AT(terrain.width)).above(0).required());
}

void add_material(Keys& k) {
  k.add(mapping("material", "a name in dem_inputs/materials, or the same keys inline").required());
  k.add(text("material.name", "for reports", COULOIR_AT(material.name)));
  k.add(number("material.density", density, "bulk density of the flow", COULOIR_AT(material.density)).above(0).required());
  k.add(number("material.internal_friction_angle", angle, "phi", COULOIR_AT(material.phi)).within(0, steepest).required());
  k.add(number("material.basal_friction_angle", angle, "delta", COULOIR_AT(material.delta)).within(0, steepest).required());
  k.add(number("material.diameter", length, "mean grain diameter of the real material", COULOIR_AT(material.diameter))
            .above(0)
            .optional());
  k.add(text("material.source", "where the numbers come from", COULOIR_AT(material.source)));
  k.add(text("material.calibration", "record in dem_inputs/calibrations that the grains' frictions come from",
             COULOIR_AT(material.calibration))
            .optional());
  k.add(mapping("material.grains", "parameters of its grains"));
  add_grain_material(k, "material.grains.", Presence::defaulted);
}

void add_release(Keys& k) {
  const auto centre = [](auto& s, int) { return std::tie(s.release.x, s.release.y); };
  const auto semi_axes = [](auto& s, int) { return std::tie(s.release.semi_x, s.release.semi_y, s.release.semi_z); };
  k.add(mapping("release", "the mass at the start").required());
  k.add(
      choice("release.kind", "its shape", {"cap", "ellipsoid", "block", "uniform", "none"}, COULOIR_AT(release.kind)).required());
  k.add(numbers("release.centre", length, "[x, y] of the middle", centre).required().when("kind", {"cap", "ellipsoid"}));
  k.add(numbers("release.position", length, "[x, y] of the middle of the upper edge", centre).required().when("kind", {"block"}));
  k.add(number("release.base_radius", length, "of the spherical cap's base", COULOIR_AT(release.base_radius))
            .above(0)
            .required()
            .when("kind", {"cap"}));
  k.add(numbers("release.semi_axes", length, "[along, across, normal] of the semi-ellipsoid", semi_axes)
            .above(0)
            .required()
            .when("kind", {"ellipsoid"}));
  k.add(number("release.length", length, "along the slope", COULOIR_AT(release.length))
            .above(0)
            .required()
            .when("kind", {"block"}));
  k.add(
      number("release.width", length, "across the slope", COULOIR_AT(release.width)).above(0).required().when("kind", {"block"}));
  k.add(number("release.height", length, "greatest depth, along the normal; uniform: the depth everywhere",
               COULOIR_AT(release.height))
            .above(0)
            .required()
            .when("kind", {"cap", "block", "uniform"}));
  k.add(number("release.velocity", velocity, "downslope, at the start", COULOIR_AT(release.velocity)).within(-1000, 1000));
  k.add(number("release.velocity_across", velocity, "towards the right, at the start", COULOIR_AT(release.velocity_across))
            .within(-1000, 1000));
  k.add(number("release.mass", mass, "the depth is scaled to hold it; missing: what the geometry holds", COULOIR_AT(release.mass))
            .above(0)
            .optional()
            .when("kind", {"cap", "ellipsoid", "block"}));
}

void add_inflow(Keys& k, const std::string& path, int side) {
  const auto at = [side](auto member) {
    return [=](auto& s, int) -> auto& {
      return s.sides[side].*member;
    };
  };
  k.add(choice(path + ".kind", "how it changes", {"uniform", "hydrograph", "silo"}, at(&SideSpec::inflow)));
  k.add(number(path + ".depth", length, "along the normal", at(&SideSpec::depth)).above(0).required().when("kind", {"uniform"}));
  k.add(number(path + ".velocity", velocity, "inward", at(&SideSpec::velocity))
            .above(0)
            .upto(1000)
            .required()
            .when("kind", {"uniform"}));
  Key table;
  table.path = path + ".hydrograph";
  table.kind = ValueKind::table;
  table.help = "rows [time, depth, velocity], times rising; linear between them, nothing before the first and after the last";
  table.columns = {time, length, velocity};
  table.column_names = {"time", "depth", "velocity"};
  table.bounds = {0, 1e6, false};
  table.presence = Presence::required;
  table.selector = "kind";
  table.selected = {"hydrograph"};
  table.get = [=](const Scene& s, int) -> Value {
    std::vector<double> out;
    for (const InflowRow& row : s.sides[side].hydrograph) out.insert(out.end(), {row.time, row.depth, row.velocity});
    return out;
  };
  table.set = [=](Scene& s, int, const Value& value) {
    const auto& list = std::get<std::vector<double>>(value);
    s.sides[side].hydrograph.clear();
    for (std::size_t n = 0; n + 2 < list.size(); n += 3) s.sides[side].hydrograph.push_back({list[n], list[n + 1], list[n + 2]});
  };
  k.add(table);
  k.add(number(
            path + ".gate", length,
            "opening of a silo's gate, the depth of the flow from it; assumed: discharge 1.03 sqrt(g) (gate - 1.4 d)^1.5 a metre "
            "of width (Beverloo, slot), d the material's diameter (without one: 0, told as a warning)",
            at(&SideSpec::gate))
            .above(0)
            .required()
            .when("kind", {"silo"}));
}

void add_boundaries(Keys& k) {
  k.add(mapping("boundaries", "what the sides of the domain do"));
  const char* sides[] = {"upstream", "downstream", "left", "right"};
  for (int side = 0; side < 4; ++side) {
    const std::string path = std::string("boundaries.") + sides[side];
    const std::vector<std::string> words{"wall", "outflow", "periodic"};
    Key key = mapping(path, side < 2 ? "this end" : side == 2 ? "the side of low y" : "the side of high y").build();
    key.choices = words;
    key.get = [=](const Scene& s, int) -> Value {
      return s.sides[side].kind == SideSpec::Kind::inflow ? "" : words[static_cast<int>(s.sides[side].kind)];
    };
    key.set = [=](Scene& s, int, const Value& value) {
      for (int kind = 0; kind < 3; ++kind) {
        if (std::get<std::string>(value) == words[kind]) s.sides[side].kind = static_cast<SideSpec::Kind>(kind);
      }
    };
    k.add(key);
    Key inflow = mapping(path + ".inflow", "material comes in").required().build();
    inflow.enter = [=](Scene& s, int) { s.sides[side].kind = SideSpec::Kind::inflow; };
    k.add(inflow);
    add_inflow(k, path + ".inflow", side);
  }
}

void add_effects(Keys& k) {
  k.add(
      mapping("effects",
              "off: a run leaves the effect out by hand; where the plan has it off anyway nothing changes, where the scene calls "
              "for it plan and run say so, or refuse where it is what the scene is made of"));
  for (const std::string name : effect_names) {
    Key key;
    key.path = "effects." + name;
    key.kind = ValueKind::choice;
    key.help = "auto: where the scene calls for it; couloir plan says why";
    key.choices = {"auto", "off"};
    key.presence = Presence::optional;
    key.get = [name](const Scene& s, int) -> Value { return s.leaves_out(name) ? "off" : ""; };
    key.set = [name](Scene& s, int, const Value& value) {
      std::erase(s.left_out, name);
      if (std::get<std::string>(value) == "off") s.left_out.push_back(name);
    };
    k.add(key);
  }
}

void add_record(Keys& k) {
  k.add(mapping("record", "what is written and how often"));
  k.add(number("record.frames", time,
               "between frames; they show no velocity up to 1e-5 of the greatest depth of release and inflows",
               COULOIR_AT(record.frames))
            .above(0));
  k.add(number("record.forces", time, "between rows of forces.csv, at least", COULOIR_AT(record.forces)).above(0));
  k.add(
      number(
          "record.checkpoint", time,
          "simulated, between checkpoints that couloir resume goes on from; 0: a twentieth of the duration, in mode continuum at "
          "least 10 s of the clock apart; with grains it changes the last bits of a run",
          COULOIR_AT(record.checkpoint))
          .within(0, 1e6));
  const auto gauge = [](auto& s, int i) {
    auto& g = s.record.gauges[i];
    return std::tie(g.x, g.y);
  };
  const auto gauge_size = [](auto& s, int i) {
    auto& g = s.record.gauges[i];
    return std::tie(g.length, g.width);
  };
  k.add(named(
      "record.gauges",
      "places where depth and velocity of the flow are recorded; it has arrived with 1 % of the greatest depth of release and "
      "inflows; modes continuum and coupled",
      [](auto& s) -> auto& { return s.record.gauges; }));
  k.add(numbers("record.gauges.*.position", length, "[x, y]; between cell centres the flow is interpolated", gauge).required());
  k.add(numbers("record.gauges.*.size", length,
                "[along, across] of a rectangle, laid like an obstacle's base: the deepest cell in it, edges included",
                gauge_size)
            .within(0, 1e6));
  k.add(number("duration", time, "simulated", COULOIR_AT(duration)).above(0).upto(1e6).required());
}

#undef COULOIR_AT

}  // namespace

std::string Key::parent() const {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string Key::name() const {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

const std::vector<Key>& schema() {
  static const std::vector<Key> keys = [] {
    Keys k;
    add_run(k);
    add_material(k);  // before the lengths and masses: its density makes the mass scale
    add_terrain(k);
    add_release(k);
    add_obstacles(k);
    add_boundaries(k);
    add_continuum(k);
    add_grains(k);
    add_effects(k);
    add_record(k);
    return k.take();
  }();
  return keys;
}

std::vector<const Key*> children(const std::string& parent) {
  std::vector<const Key*> found;
  for (const Key& key : schema()) {
    if (key.parent() == parent) found.push_back(&key);
  }
  return found;
}

const Key& schema_key(const std::string& path) {
  for (const Key& key : schema()) {
    if (key.path == path) return key;
  }
  throw std::out_of_range("the scene schema has no key " + path);
}

std::string allowed_values(const Key& key) {
  if (!key.choices.empty() && key.kind != ValueKind::number) return fmt::format("{}", fmt::join(key.choices, ", "));
  const Bounds& b = key.bounds;
  const bool whole = key.kind == ValueKind::integer;
  const auto show = [&](double v) { return whole ? fmt::format("{:.0f}", v) : short_quantity(v, key.dimension); };
  const bool low = std::isfinite(b.least), high = std::isfinite(b.most);
  if (low && high && b.above) return fmt::format("above {} and at most {}", show(b.least), show(b.most));
  if (low && high) return fmt::format("from {} to {}", show(b.least), show(b.most));
  if (low) return fmt::format("{} {}", b.above ? "above" : "at least", show(b.least));
  if (high) return fmt::format("at most {}", show(b.most));
  return "";
}

}  // namespace couloir
