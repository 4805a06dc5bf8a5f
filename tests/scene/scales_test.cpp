// Every bare quantity of a scene is a multiple of its scale in (2.47): the same text is read with scales and without.

#include <algorithm>
#include <cmath>
#include <set>

#include "coupling/scene/schema.hpp"
#include "scene_fixture.hpp"

namespace couloir {
namespace {

constexpr double length = 2;  // [m]

const std::string bare_scene =
    "mode: coupled\n"
    "material: {density: 1200, internal_friction_angle: 35 deg, basal_friction_angle: 25 deg, diameter: 0.004, grains: "
    "{youngs_modulus: 6e6}}\n"
    "terrain: {kind: chute, angle: 35 deg, slope: 2, arc: 0.4, runout: 0.6, width: 0.8}\n"
    "release: {kind: cap, centre: [0.4, 0.02], base_radius: 0.3, height: 0.1, velocity: 0.5}\n"
    "obstacles:\n"
    "  wall: {position: [1.2, 0.02], size: [0.05, 0.1, 0.08], gauges: {m: {centre: [0.01, 0.03], size: [0.02, 0.04]}}}\n"
    "continuum: {cell: 0.01, cell_across: 0.02, adapt: {levels: 1, obstacle: 0.02}, refine: [{around: wall, up: 0.03, down: "
    "0.04, "
    "left: 0.05, right: 0.06, margin: 0.01}]}\n"
    "grains: {diameter: 0.005, timestep: 1e-5, skin: 0.001, timeout: 100, zone: {x: [1, 1.5], y: [-0.3, 0.25]}}\n"
    "record: {frames: 0.25, forces: 0.125, checkpoint: 0.5, gauges: {one: {position: [1.1, 0.03], size: [0.02, 0.04]}}}\n"
    "duration: 1.5\n";

class SceneScales : public SceneFixture {
 protected:
  void compare(const Overrides& overrides) {
    const Scene plain = read(bare_scene, overrides), scaled = read("scales: {length: 2 m}\n" + bare_scene, overrides);
    const Scales scales{length, plain.gravity, plain.material.density};
    for (const Key& key : schema()) {
      if (!key.get || !belongs(plain, key)) continue;
      const Value a = key.get(plain, 0), b = key.get(scaled, 0);
      const std::vector<double> one = numbers(a), other = numbers(b);
      ASSERT_EQ(one.size(), other.size()) << key.path;
      for (std::size_t n = 0; n < one.size(); ++n) {
        const Dimension d = key.kind == ValueKind::table ? key.columns[n % key.columns.size()] : key.dimension;
        const double factor = key.scaled ? scales.of(d) : 1;
        if (one[n] != 0 && other[n] == one[n] * factor && factor != 1) met_.insert(key.path);
        // What is not given keeps its default, which is SI.
        EXPECT_TRUE(other[n] == one[n] * factor || other[n] == one[n]) << key.path << " " << one[n] << " " << other[n];
      }
    }
  }

  std::set<std::string> met_;  // keys seen to be scaled

 private:
  static std::vector<double> numbers(const Value& value) {
    if (const auto* x = std::get_if<double>(&value)) return {*x};
    if (const auto* list = std::get_if<std::vector<double>>(&value)) return *list;
    return {};
  }
  static bool belongs(const Scene& scene, const Key& key) {
    const bool of_box = key.parent() == "grains.zone" || key.parent() == "grains.zones.*";
    if (of_box && scene.grains.zones.empty()) return false;
    if (key.selector.empty()) return true;
    const auto word = std::get<std::string>(schema_key(key.parent() + "." + key.selector).get(scene, 0));
    return std::ranges::count(key.selected, word) > 0;
  }
};

TEST_F(SceneScales, EveryBareQuantityIsScaled) {
  compare({});
  compare({{"terrain", "{kind: incline, angle: 35 deg, length: 3, width: 0.8}"}});
  compare({{"terrain", "{kind: profile, profile: [[0, 35 deg], [2.5, 35 deg], [3, 0 deg]], width: 0.8}"}});
  compare({{"release", "{kind: ellipsoid, centre: [0.4, 0.02], semi_axes: [0.3, 0.2, 0.1], mass: 0.01}"}, {"mode", "continuum"}});
  compare({{"release", "{kind: block, position: [0.1, 0.01], length: 0.3, width: 0.2, height: 0.1, velocity_across: 0.5}"}});
  compare({{"continuum.refine", "[{x: [0.5, 0.75], y: [-0.1, 0.2]}]"}});
  compare({{"obstacles.wall.gauges", "{m: {centre: [0.01, 0.03], radius: 0.02}}"}});
  compare({{"obstacles.wall.method", "elevation"}, {"obstacles.wall.ramp", "0.02"}});
  compare(
      {{"grains.rotation", "{control: {retarding_time: 0.005, shear_influence: 0.01, slide_to_roll: 0.2, roll_to_slide: 0.1}}"}});
  for (const char* side : {"upstream", "downstream", "left", "right"}) {
    const std::string inflow = std::string("boundaries.") + side + ".inflow";
    compare({{inflow, "{depth: 0.04, velocity: 0.5}"}});
    compare({{inflow, "{kind: hydrograph, hydrograph: [[0.5, 0.04, 0.5], [1, 0.02, 0.25]]}"}});
    compare({{inflow, "{kind: silo, gate: 0.04}"}});
  }
  for (const Key& key : schema()) {
    const bool quantity = key.kind == ValueKind::table || Scales{length, 9.81, 1200}.of(key.dimension) != 1;
    if (quantity && key.scaled && key.set) {
      EXPECT_TRUE(met_.contains(key.path)) << key.path << " is a quantity that no scene of this test has";
    }
  }
}

// The scales themselves, angles, and what the clock on the wall measures.
TEST_F(SceneScales, WhatIsNotScaled) {
  const Scene s = read("scales: {length: 2}\ngravity: 4\n" + bare_scene);
  EXPECT_EQ(s.terrain.slope, 4);
  EXPECT_EQ(s.gravity, 4);
  EXPECT_EQ(s.material.density, 1200);
  EXPECT_EQ(s.grains.timeout, 100);
  EXPECT_EQ(s.continuum.cfl, 0.45);
  EXPECT_DOUBLE_EQ(s.duration, 1.5 * std::sqrt(2.0 / 4));
}

}  // namespace
}  // namespace couloir
