#include "coupling/plan/plan.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/plan/build.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(Plan, OfTheWall) {
  const Plan plan = make_plan(experiment("chiou_wall"));
  EXPECT_DOUBLE_EQ(plan.release_mass, 1.41);
  EXPECT_EQ(plan.cells, 383 * 160);
  // 0.45 * 5 mm over a flow between 1 and 10 m/s.
  EXPECT_GT(plan.dt, 2.2e-4);
  EXPECT_LT(plan.dt, 2.3e-3);
  EXPECT_NEAR(static_cast<double>(plan.steps), 1.5 / plan.dt, 1);
  ASSERT_EQ(plan.zones.size(), 1u);
  EXPECT_LT(plan.zones[0].box.x0, 0.65);
  // 2.207 L at a solid fraction of .57 in grains of 4 mm, spread .1: 37.2 thousand.
  EXPECT_NEAR(static_cast<double>(plan.grains[2]), 2.2066e-3 * 0.57 / (3.351e-8 * 1.01), 100);
  EXPECT_GT(plan.grains[1], 1000);
  EXPECT_LE(plan.grains[1], plan.grains[2]);
  EXPECT_EQ(plan.grains[0], 0);
  EXPECT_GT(plan.engine_steps, 10000);
  EXPECT_GT(plan.memory, 1e7);
  EXPECT_DOUBLE_EQ(plan.time, plan.time_continuum + plan.time_engine);
  EXPECT_THAT(plan.warnings, Not(Contains(HasSubstr("above 0.4"))));
}

TEST(Plan, SaysWhereFrictionsAreNotThoseOfTheirCalibration) {
  const auto warnings = [](const Overrides& more) { return make_plan(experiment("chiou_wall", more)).warnings; };
  EXPECT_THAT(warnings({}), Not(Contains(HasSubstr("of the record"))));
  EXPECT_THAT(warnings({{"grains.rolling_friction", "0.15"}}),
              Contains(HasSubstr("0.445 is above 0.4 and the rolling friction between grains, 0.15, below 0.4")));
  EXPECT_THAT(warnings({{"grains.diameter", "6 mm"}, {"grains.engine", "yade"}, {"grains.rotation", "blocked"}}),
              Contains(HasSubstr("of the record vestolen-liggghts-4mm, these grains would be vestolen-yade-6mm-blocked")));
  EXPECT_THAT(warnings({{"grains.tangential_damping", "off"}}),
              Contains(HasSubstr("these grains would be vestolen-liggghts-4mm-hertz-undamped")));
  EXPECT_THAT(warnings({{"grains.friction", "0.1"}}),
              Contains(HasSubstr("The scene sets grains.friction itself: the angles of the record")));
  EXPECT_THAT(warnings({{"grains.contact", "kelvin_voigt"}, {"grains.rolling_friction", "0.3"}}),
              Contains(HasSubstr("grains.rolling_friction has no effect: contact kelvin_voigt has no rolling friction.")));
  const std::string slow = "{control: {retarding_time: 10 s}}", own = "vestolen-liggghts-4mm-control-10ms";
  EXPECT_THAT(warnings({{"material.calibration", own}, {"grains.rotation", slow}}),
              Contains(HasSubstr("vestolen-liggghts-4mm-control-10000ms")));
  EXPECT_THAT(warnings({{"material.calibration", own}, {"grains.rotation", "{control: {retarding_time: 10 ms}}"}}),
              Not(Contains(HasSubstr("of the record"))));
  EXPECT_THAT(warnings({{"release.velocity", "20 m/s"}, {"grains.window", "4"}}),
              Contains(HasSubstr("they are too soft for that")));
  EXPECT_THAT(warnings({}), Not(Contains(HasSubstr("too soft"))));
  const auto once = HasSubstr("grains.replicates is 3, but nothing in mode continuum is random");
  EXPECT_THAT(warnings({{"mode", "continuum"}, {"grains.replicates", "3"}}), Contains(once));
  EXPECT_THAT(warnings({{"grains.replicates", "3"}}), Not(Contains(once)));
  EXPECT_THAT(warnings({{"mode", "continuum"}, {"grains.diameter", "6 mm"}}), Not(Contains(HasSubstr("of the record"))));
}

TEST(Plan, SaysTheScheme) {
  const Overrides noc = {{"mode", "continuum"}, {"continuum.scheme", "noc"}, {"continuum.limiter", "eno"}, {"obstacles", "{}"}};
  const Plan plan = make_plan(experiment("chiou_wall", noc));
  EXPECT_THAT(plan_text(plan), HasSubstr("scheme     noc, limiter eno; instructions "));
  EXPECT_EQ(plan_json(plan)["continuum"]["scheme"], "noc");
  EXPECT_EQ(solver_settings(experiment("chiou_wall", noc)).limiter, Limiter::eno);
  const Plan upwind = make_plan(experiment("chiou_wall", {{"mode", "continuum"}, {"obstacles", "{}"}}));
  EXPECT_THAT(plan_text(upwind), HasSubstr("scheme     central_upwind, limiter minmod; instructions "));
  EXPECT_DOUBLE_EQ(plan.dt, 2 * upwind.dt);  // a step of noc is a pair
}

TEST(Plan, TellsWhatStressGaugesRead) {
  const auto plan = [](Overrides more) {
    more.insert(more.begin(), {"obstacles.wall.gauges", "{m: {centre: [0, 40 mm], radius: 20 mm}}"});
    return make_plan(experiment("chiou_wall", more));
  };
  const auto text = [&](const Overrides& more) { return plan_text(plan(more)); };
  EXPECT_THAT(text({}),
              HasSubstr("gauge      wall.m: round, 40 mm across, 10.0 grains wide: normal stress, shear up and across\n"));
  EXPECT_THAT(
      text({{"mode", "continuum"}}),
      HasSubstr(
          "gauge      wall.m: records nothing in mode continuum: a depth-averaged flow has no stress on a part of a face\n"));
  const Overrides aside{{"obstacles.post", "{position: [0.8 m, 0.2 m], size: [20 mm, 60 mm, 40 mm]}"},
                        {"obstacles.post.gauges", "{m: {centre: [0, 20 mm], size: [20 mm, 12 mm]}}"},
                        {"grains.zone", "{x: [0.5 m, 0.7 m], y: [-0.12 m, 0.12 m]}"}};
  EXPECT_THAT(text(aside), HasSubstr("gauge      post.m: records nothing, since post lies outside the zone of grains\n"));
  const Plan narrow = plan({{"mode", "grains"}, {"obstacles.wall.gauges", "{m: {centre: [0, 40 mm], size: [20 mm, 10 mm]}}"}});
  EXPECT_THAT(narrow.warnings, Contains("Gauge wall.m is only 2.5 grains wide: single contacts will show in its stresses."));
  EXPECT_EQ(plan_json(narrow)["stress_gauges"][0], "wall.m: 20 mm by 10 mm, 2.5 grains wide: normal stress, shear up and across");
  EXPECT_THAT(plan({}).warnings, Not(Contains(HasSubstr("Gauge"))));
}

TEST(Plan, ContinuumHasNoEngine) {
  const Plan plan = make_plan(experiment("chiou_wall", {{"mode", "continuum"}}));
  EXPECT_EQ(plan.engine_dt, 0);
  EXPECT_EQ(plan.engine_steps, 0);
  EXPECT_EQ(plan.time_engine, 0);
  EXPECT_TRUE(plan.zones.empty());
  EXPECT_TRUE(plan.warnings.empty());
  EXPECT_GT(plan.grains[2], 0) << "still told for comparison";
}

TEST(Plan, GrainsHasNoMesh) {
  const Plan plan = make_plan(experiment("chiou_wall", {{"mode", "grains"}}));
  EXPECT_EQ(plan.cells, 0);
  EXPECT_EQ(plan.steps, 0);
  EXPECT_EQ(plan.time_continuum, 0);
  EXPECT_TRUE(plan.zones.empty());
  EXPECT_GT(plan.time_engine, 0);
  EXPECT_GT(plan.time_engine, make_plan(experiment("chiou_wall")).time_engine) << "a zone has fewer grains than the whole flow";
}

TEST(Plan, TheSlowerEngineAndTheStifferLawTakeLonger) {
  const double hertz = make_plan(experiment("chiou_wall")).time_engine;
  EXPECT_GT(make_plan(experiment("chiou_wall", {{"grains.engine", "yade"}})).time_engine, 3 * hertz);
  const Plan linear = make_plan(experiment("chiou_wall", {{"grains.contact", "kelvin_voigt"}}));
  EXPECT_GT(linear.time_engine, hertz);
}

TEST(Plan, OfAContinuumSceneWithoutGrains) {
  Scene scene = experiment("chiou_wall", {{"mode", "continuum"}});
  scene.grains.diameter = 0;
  const Plan plan = make_plan(scene);
  EXPECT_EQ(plan.grains[1], 0);
  EXPECT_EQ(plan.grains[2], 0);
}

TEST(Plan, FinerCostsMore) {
  const Plan coarse = make_plan(experiment("chiou_wall")),
             fine = make_plan(experiment("chiou_wall", {{"continuum.cell", "2.5 mm"}}));
  EXPECT_EQ(fine.cells, 4 * coarse.cells);
  EXPECT_NEAR(fine.dt / coarse.dt, 0.5, 1e-9);
  EXPECT_NEAR(fine.time_continuum / coarse.time_continuum, 8, 0.1);
}

TEST(Plan, WarnsOfWhatDoesNotMatch) {
  const Plan plan = make_plan(experiment(
      "chiou_wall",
      {{"grains.base_friction", "0.3"}, {"grains.zone", "{x: [0.61, 0.7], y: [-0.2, 0.2]}"}, {"grains.follow", "off"}}));
  EXPECT_THAT(plan.warnings,
              Contains("The two models brake differently: base friction of the grains is 0.3, tan(delta) is 0.445."));
  EXPECT_THAT(plan.warnings,
              Contains("The zone reaches only 10 grain diameters upstream of wall; the pile will reach its face."));
  EXPECT_THAT(plan.warnings, Not(Contains(HasSubstr("above 0.4"))));
  EXPECT_THAT(make_plan(experiment("null_zone")).warnings, testing::IsEmpty());
  const char* side = "boundaries.upstream";
  EXPECT_THAT(make_plan(experiment("null_zone", {{side, "{inflow: {depth: 40 mm, velocity: 0.3 m/s}}"}})).warnings,
              Contains(HasSubstr("slower than its waves (Froude 0.50)")));
  EXPECT_THAT(make_plan(experiment("wedge_silo")).warnings, Not(Contains(HasSubstr("slower than its waves"))));
  // 1 - (1 - 1.4 d / gate)^1.5 = 0.0209 and 0.2025
  EXPECT_THAT(
      make_plan(experiment("wedge_silo")).warnings,
      Contains("The material has no diameter: the silo's rate upstream is assumed to be that of grains without size, the most "
               "the gate lets through; grains of 0.09 mm would bring 2.1 % less, of 0.9 mm 20 %. Give material.diameter."));
  EXPECT_THAT(
      make_plan(experiment("wedge_silo", {{"material", "vestolen"}, {"boundaries.upstream.inflow.gate", "18 mm"}})).warnings,
      Not(Contains(HasSubstr("no diameter"))));
}

TEST(Plan, WarnsOfAnObstacleThatTheFlowDoesNotReach) {
  EXPECT_THAT(make_plan(experiment("chiou_wall", {{"duration", "0.1 s"}})).warnings,
              Contains(HasSubstr("later than the run ends")));
  EXPECT_THAT(make_plan(experiment("chiou_wall", {{"terrain.angle", "10 deg"}})).warnings,
              Contains(HasSubstr("expected to stop")));
  EXPECT_THAT(make_plan(experiment("chiou_wall")).warnings, Not(Contains(HasSubstr("is expected to stop"))));
}

TEST(Plan, AsTextAndJson) {
  const Plan plan = make_plan(experiment("chiou_wall"));
  const std::string text = plan_text(plan);
  EXPECT_THAT(text, HasSubstr("mesh       383 x 160 cells of 5 mm x 5 mm\n"));
  EXPECT_THAT(text, HasSubstr("release    1.41 kg, 2.207 L\n"));
  const auto left_out = text.find("\nleft out\n");
  for (const Effect& e : plan.effects) {
    const auto line = text.find(fmt::format("\n  {:<20} {}\n", e.name, e.reason));
    ASSERT_NE(line, std::string::npos) << e.name;
    EXPECT_EQ(line < left_out, e.on) << e.name;
  }
  for (const std::string& w : plan.warnings) EXPECT_THAT(text, HasSubstr(w));
  const nlohmann::json json = nlohmann::json::parse(plan_json(plan).dump());
  EXPECT_EQ(json["mode"], "coupled");
  EXPECT_EQ(json["continuum"]["cells"], 383 * 160);
  EXPECT_EQ(json["effects"].size(), plan.effects.size());
  EXPECT_EQ(json["effects"][0]["name"], "depth_averaged_flow");
  EXPECT_EQ(json["zone"]["x"][0], plan.zones[0].box.x0);
  EXPECT_TRUE(plan_json(make_plan(experiment("chiou_wall", {{"mode", "grains"}})))["zone"].is_null());
}

}  // namespace
}  // namespace couloir
