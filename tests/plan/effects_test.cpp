#include "coupling/plan/effects.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "coupling/plan/build.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

Effect effect(const Scene& scene, const std::string& name) {
  for (const Effect& e : effects_of(scene)) {
    if (e.name == name) return e;
  }
  throw std::out_of_range(name);
}

void expect(const Scene& scene, const std::string& name, bool on, const std::string& reason) {
  const Effect e = effect(scene, name);
  EXPECT_EQ(e.on, on) << name;
  EXPECT_EQ(e.reason, reason) << name;
}

TEST(Effects, OfTheWall) {
  const Scene s = experiment("chiou_wall");
  expect(s, "depth_averaged_flow", true, "mode is coupled");
  expect(s, "gravity_along_slope", true, "the terrain is inclined by 40 deg");
  expect(s, "earth_pressure", true, "closure is active_passive: phi 37 deg and delta 24 deg give K_act 0.61319, K_pas 3.65818");
  expect(s, "basal_friction", true, "Coulomb, delta 24 deg");
  expect(s, "curvature", true, "the terrain has an arc of 146.5 mm with radius 209.846 mm");
  expect(s, "steps_of_the_bed", false, "grains of the zone meet the obstacles as solid bodies");
  expect(s, "elevation", false, "no obstacle is an elevation of the bed");
  expect(s, "planes", false, "no obstacle is made of planes");
  expect(s, "across_slope", true, "the domain has 160 rows of cells: the 2D model (2.87)-(2.92)");
  expect(s, "solid_bodies", true, "in the zone of grains: wall (80 mm high)");
  expect(s, "inflow", false, "no side of the domain is an inflow");
  expect(s, "periodic_sides", false, "no sides are periodic");
  expect(s, "grain_engine", true, "mode is coupled: liggghts, contact hertz, grains of 4 mm, 1 rank");
  expect(s, "side_friction", false, "neither the left nor the right side is a wall");
  expect(s, "coupling", true, "mode is coupled, with an automatic zone around the obstacles");
  EXPECT_TRUE(effect(s, "airborne").on);
  EXPECT_NE(effect(s, "airborne").reason.find("become flow where they come down"), std::string::npos);
}

TEST(Effects, OfTheNullZone) {
  const Scene s = experiment("null_zone");
  expect(s, "earth_pressure", false, "closure is hydraulic: K = 1");
  expect(s, "curvature", false, "the terrain has no arc: kappa is 0 everywhere");
  expect(s, "solid_bodies", false, "the scene has no obstacles");
  expect(s, "steps_of_the_bed", false, "no obstacle is a step of the bed");
  expect(s, "inflow", true, "upstream: 40 mm deep at 1.002 m/s");
  expect(s, "periodic_sides", true, "left and right are periodic");
  expect(s, "coupling", true, "mode is coupled, with the zone that the scene gives");
  expect(s, "airborne", false, "no obstacle throws grains above the flow");
}

TEST(Effects, OfOtherModes) {
  const Scene continuum = experiment("chiou_wall", {{"mode", "continuum"}});
  expect(continuum, "grain_engine", false, "mode is continuum: no engine is started");
  expect(continuum, "steps_of_the_bed", true, "the bed jumps, nothing flows through: wall (80 mm high)");
  expect(continuum, "solid_bodies", false, "mode is continuum: no grains");
  expect(continuum, "coupling", false, "mode is continuum: one model alone");
  expect(continuum, "airborne", false, "mode is continuum: a depth-averaged flow has no flight");
  expect(continuum, "rolling_friction", false, "mode is continuum: no grains");
  const Scene grains = experiment("chiou_wall", {{"mode", "grains"}});
  expect(grains, "depth_averaged_flow", false, "mode is grains: grains carry the whole flow");
  expect(grains, "earth_pressure", false, "mode is grains: stresses come from the contacts");
  expect(grains, "curvature", false, "mode is grains: the grains move on the curved bed itself");
  expect(grains, "solid_bodies", true, "among the grains: wall (80 mm high)");
  expect(grains, "steps_of_the_bed", false, "mode is grains: grains meet the obstacles as solid bodies");
  expect(grains, "airborne", false, "mode is grains: grains fly as grains");
}

TEST(Effects, OfTheLinearContactLaw) {
  const Scene s = experiment("chiou_wall", {{"grains.contact", "kelvin_voigt"}, {"grains.engine", "yade"}});
  expect(s, "grain_engine", true, "mode is coupled: yade, contact kelvin_voigt, grains of 4 mm, 1 rank");
  expect(experiment("chiou_wall", {{"grains.tangential_damping", "off"}}), "grain_engine", true,
         "mode is coupled: liggghts, contact hertz without tangential damping, grains of 4 mm, 1 rank");
  expect(s, "rolling_friction", false, "grains.contact is kelvin_voigt, which has none");
  expect(s, "rotation_control", false, "grains.rotation is free: contacts alone turn a grain");
  const Scene blocked = experiment("chiou_wall", {{"grains.rotation", "blocked"}});
  expect(blocked, "rolling_friction", false, "grains.rotation is blocked: none rolls");
  expect(blocked, "rotation_control", true, "grains.rotation is blocked: no grain turns");
  const std::string control = "grains.rotation.control.";
  const Scene slowed = experiment("chiou_wall", {{control + "retarding_time", "5 ms"}, {control + "contact_influence", "2"}});
  expect(slowed, "rotation_control", true, "grains.rotation has control: (4.11), (4.12) with lambda_c 5 ms and chi 2");
  const Scene all = experiment("chiou_wall", {{control + "retarding_time", "5 ms"},
                                              {control + "shear_influence", "0.01 s2/m"},
                                              {control + "slide_to_roll", "0.1 m/s"},
                                              {control + "roll_to_slide", "0.02 m/s"}});
  expect(
      all, "rotation_control", true,
      "grains.rotation has control: (4.11), (4.12) with lambda_c 5 ms and chi 1; longer in shear, (4.13) with k_v 0.01 s2/m; a "
      "grain without spin slides below 0.1 m/s, one with spin comes to slide below 0.02 m/s");
  expect(experiment("chiou_wall", {{"mode", "continuum"}}), "rotation_control", false, "mode is continuum: no grains");
}

TEST(Effects, SwitchedOff) {
  expect(experiment("chiou_wall", {{"continuum.curvature", "off"}}), "curvature", false,
         "continuum.curvature is off, although the terrain has an arc");
  expect(experiment("chiou_wall", {{"material.basal_friction_angle", "0"}}), "basal_friction", false,
         "delta is 0: a frictionless bed");
  expect(experiment("null_zone", {{"terrain", "{kind: flat, length: 0.8, width: 0.06}"}}), "gravity_along_slope", false,
         "the terrain is level");
  const Overrides walls{{"boundaries.left", "wall"}, {"boundaries.right", "wall"}, {"grains.side_friction", "0.3"}};
  expect(experiment("chiou_wall", walls), "side_friction", true, "grains meet the side walls with friction 0.3");
}

TEST(Effects, OfOneRowOfCells) {
  const Scene s = experiment("flume_continuum", {{"continuum.cell_across", "0.3 m"}});
  expect(s, "across_slope", false, "the domain is one row of cells: the 1D model (2.2), (2.11)");
}

// Without friction and without inclination there is nothing that curvature could press on, nor any curvature.
TEST(Effects, WhatTheSceneLeavesWithoutEffect) {
  const Scene smooth = experiment("chiou_vestolen", {{"material.basal_friction_angle", "0"}});
  expect(smooth, "curvature", false, "it presses the flow onto its bed, which is frictionless: delta is 0");
  EXPECT_FALSE(solver_settings(smooth).closure.curvature);
  const Scene level = experiment("chiou_vestolen", {{"terrain.angle", "0"}});
  expect(level, "curvature", false, "the terrain has no arc: kappa is 0 everywhere");
  expect(level, "gravity_along_slope", false, "the terrain is level");
  EXPECT_FALSE(solver_settings(level).closure.curvature);
  const Scene fluid =
      experiment("chiou_vestolen", {{"material.basal_friction_angle", "0"}, {"material.internal_friction_angle", "0"}});
  expect(fluid, "earth_pressure", false, "closure is active_passive, but phi is 0, which gives K = 1");
  EXPECT_TRUE(solver_settings(fluid).closure.earth_pressure.is_hydraulic());
}

TEST(Effects, OfTwoInflows) {
  const Scene s = experiment("wedge_silo", {{"boundaries.left", "{inflow: {depth: 10 mm, velocity: 1}}"}});
  expect(s, "inflow", true,
         "upstream: 9 mm deep at 0.30605 m/s from a silo's gate (velocity by Beverloo's law with d = 0: assumed); left: 10 mm "
         "deep at 1 m/s");
  const Scene known = experiment("wedge_silo", {{"material", "vestolen"}, {"boundaries.upstream.inflow.gate", "18 mm"}});
  expect(known, "inflow", true, "upstream: 18 mm deep at 0.247475 m/s from a silo's gate (velocity by Beverloo's law: assumed)");
}

// In mode coupled an obstacle is what its surroundings are: solid among grains, else what its method says.
TEST(Effects, OfObstaclesInsideAndOutsideOfTheZone) {
  const Overrides overrides{{"obstacles.hill", "{position: [1.2 m, 0], size: [50 mm, 80 mm, 20 mm], method: elevation}"},
                            {"grains.zone", "{x: [0.5 m, 0.7 m], y: [-0.12 m, 0.12 m]}"}};
  Scene s = experiment("chiou_wall", overrides);
  expect(s, "solid_bodies", true, "in the zone of grains: wall (80 mm high)");
  expect(s, "elevation", true, "bed heights of obstacles, (4.4)-(4.9): hill (20 mm high)");
  s = experiment("chiou_wall", {{"obstacles.wall.method", "elevation"}});
  expect(s, "elevation", false, "grains of the zone meet the obstacles as solid bodies");
}

// In one effect, by its method and what carries the flow around it.
TEST(Effects, TellOfEachObstacleOnce) {
  const std::map<std::string, std::string> at{{"step", "steps_of_the_bed"}, {"elevation", "elevation"}, {"planes", "planes"}};
  for (const auto& [method, name] : at) {
    for (const char* mode : {"continuum", "coupled", "grains"}) {
      const Scene s = experiment("chiou_wall", {{"mode", mode}, {"obstacles.wall.method", method}});
      int told = 0;
      for (const Effect& e : effects_of(s)) {
        if (!e.on || e.reason.find("wall (80 mm high)") == std::string::npos) continue;
        ++told;
        EXPECT_EQ(e.name, mode == std::string("continuum") ? name : "solid_bodies");
      }
      EXPECT_EQ(told, 1) << method << ", " << mode;
    }
  }
  expect(experiment("eta_study"), "planes", true, "flows of their own on five planes: wall (79.992 mm high), eta 0.8");
}

// The whole list of each experiment: what it simulates, and nothing else.
TEST(Effects, OfEveryExperiment) {
  using Names = std::set<std::string>;
  const Names chute{"depth_averaged_flow", "across_slope",   "gravity_along_slope",
                    "earth_pressure",      "basal_friction", "curvature"};
  const Names incline{"depth_averaged_flow", "across_slope", "gravity_along_slope", "earth_pressure", "basal_friction"};
  const Names grains{"grain_engine", "rolling_friction", "coupling"};
  const auto with = [](Names names, const Names& more) {
    names.insert(more.begin(), more.end());
    return names;
  };
  const std::map<std::string, Names> expected{
      {"block_wall", with(with(incline, grains), {"airborne", "solid_bodies"})},
      {"dam_break", {"depth_averaged_flow", "gravity_along_slope", "basal_friction"}},
      {"chiou_gauge", with(with(chute, grains), {"airborne", "solid_bodies"})},
      {"chiou_refinement", with(chute, {"steps_of_the_bed"})},
      {"chiou_vestolen", with(chute, {"steps_of_the_bed"})},
      {"chiou_wall", with(with(chute, grains), {"airborne", "solid_bodies"})},
      {"chiou_wall_quartz", {"across_slope", "gravity_along_slope", "solid_bodies", "grain_engine", "rolling_friction"}},
      {"cuboid_force", with(chute, {"steps_of_the_bed"})},
      {"eta_study", with(chute, {"planes"})},
      {"flume_continuum", incline},
      {"coupling_invariance", with(with(incline, grains), {"airborne", "solid_bodies"})},
      {"moriguchi_flume", with(with(incline, grains), {"airborne", "solid_bodies"})},
      {"slit_and_pillars", with(with(incline, grains), {"airborne", "solid_bodies"})},
      {"wall_overtopped", with(with(chute, grains), {"airborne", "solid_bodies"})},
      {"catching_dam", with(with(chute, grains), {"airborne", "solid_bodies"})},
      {"null_zone_arc", with(grains, {"depth_averaged_flow", "across_slope", "gravity_along_slope", "basal_friction", "curvature",
                                      "periodic_sides"})},
      {"null_zone", with(grains, {"depth_averaged_flow", "across_slope", "gravity_along_slope", "basal_friction", "inflow",
                                  "periodic_sides"})},
      {"rotation_flume", {"across_slope", "gravity_along_slope", "solid_bodies", "grain_engine"}},
      {"wedge_silo", with(chute, {"elevation", "inflow"})},
      {"wedge_force", with(chute, {"elevation"})},
      {"wedge_critical_height", with(chute, {"elevation"})}};
  for (const auto& folder : std::filesystem::directory_iterator(COULOIR_SOURCE_DIR "/experiments")) {
    const std::string name = folder.path().filename().string();
    if (!std::filesystem::exists(folder.path() / "scene.yaml")) continue;
    ASSERT_TRUE(expected.contains(name)) << name << " is new: say here what it simulates";
    Names on;
    for (const Effect& e : effects_of(experiment(name))) {
      if (e.on) on.insert(e.name);
    }
    EXPECT_EQ(on, expected.at(name)) << name;
  }
}

TEST(Effects, EachHasOneNameAndAReason) {
  for (const char* mode : {"continuum", "coupled", "grains"}) {
    std::set<std::string> names;
    for (const Effect& e : effects_of(experiment("chiou_wall", {{"mode", mode}}))) {
      EXPECT_TRUE(names.insert(e.name).second) << e.name;
      EXPECT_FALSE(e.reason.empty()) << e.name;
    }
  }
}

TEST(Effects, ElevationIsOnWithItsBodies) {
  const Overrides overrides{{"obstacles.wedge", "{shape: tetrahedron, position: [0.75 m, 0], size: [69 mm, 80 mm, 40 mm]}"},
                            {"mode", "continuum"}};
  const Scene s = experiment("chiou_wall", overrides);
  expect(s, "elevation", true, "bed heights of obstacles, (4.4)-(4.9): wedge (40 mm high)");
  expect(s, "steps_of_the_bed", true, "the bed jumps, nothing flows through: wall (80 mm high)");
  const Scene grains = experiment("chiou_wall", {overrides[0], {"mode", "grains"}});
  expect(grains, "elevation", false, "mode is grains: grains meet the obstacles as solid bodies");
  expect(grains, "solid_bodies", true, "among the grains: wall (80 mm high), wedge (40 mm high)");
  const Scene smooth = experiment("chiou_wall", {{"obstacles.wall.method", "elevation"}, {"mode", "continuum"}});
  expect(smooth, "elevation", true, "bed heights of obstacles, (4.4)-(4.9): wall (80 mm high)");
}

}  // namespace
}  // namespace couloir
