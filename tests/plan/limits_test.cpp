#include "coupling/plan/limits.hpp"

#include <gtest/gtest.h>

#include "coupling/plan/build.hpp"
#include "coupling/plan/stiffness.hpp"
#include "coupling/scene/scene_error.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

// The sentence with which the plan is refused; empty: it is not.
std::string refusal(const Overrides& changes) {
  try {
    make_plan(experiment("chiou_wall", changes));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Limits, AnEngineStepIsAtMostAQuarterAboveTheStableOne) {
  const Scene s = experiment("chiou_wall");
  const double stable = stable_timestep(s, expected_grain_density(s));
  EXPECT_EQ(refusal({{"grains.timestep", std::to_string(1.2e6 * stable) + "e-6 s"}}), "");
  const std::string why = refusal({{"grains.timestep", "1 ms"}});
  EXPECT_TRUE(holds(why, "--set grains.timestep") && holds(why, "at most 29.19 us")) << why;
}

TEST(Limits, ALinearContactHasItsOwnStableStep) {
  const std::string why = refusal({{"grains.timestep", "1 ms"}, {"grains.contact", "kelvin_voigt"}});
  EXPECT_TRUE(holds(why, "at most ") && holds(why, "a sixteenth of its contact time")) << why;
}

TEST(Limits, ASkinIsAtMostThreeDiameters) {
  EXPECT_EQ(refusal({{"grains.skin", "12 mm"}}), "");
  const std::string why = refusal({{"grains.skin", "13 mm"}});
  EXPECT_TRUE(holds(why, "--set grains.skin") && holds(why, "more than three diameters, 12 mm")) << why;
}

TEST(Limits, AWindowIsShorterThanTheFlowsWayThroughHalfTheDrivenLayer) {
  EXPECT_EQ(refusal({{"grains.window", "100"}}), "");
  const std::string why = refusal({{"grains.window", "3000"}});
  EXPECT_TRUE(holds(why, "--set grains.window") && holds(why, "use at most 112 steps")) << why;
  EXPECT_EQ(refusal({{"grains.window", "112"}}), "") << "the remedy that the sentence names is one";
  EXPECT_EQ(refusal({{"grains.window", "3000"}, {"mode", "continuum"}}), "");
}

TEST(Limits, AWindowIsJudgedByTheFastestSourceWhateverTheDuration) {
  const Overrides fed{{"boundaries.upstream", "{inflow: {depth: 30 mm, velocity: 0.1 m/s}}"}};
  EXPECT_EQ(refusal(fed), "");
  Overrides fast = fed;
  fast.emplace_back("release.velocity", "12 m/s");
  EXPECT_TRUE(holds(refusal(fast), "grains.window")) << refusal(fast);
  EXPECT_TRUE(holds(refusal({{"boundaries.left", "{inflow: {depth: 30 mm, velocity: 20 m/s}}"}}), "grains.window"));
  EXPECT_TRUE(holds(refusal({{"grains.window", "3000"}, {"duration", "0.1 s"}}), "use at most 112 steps"));
}

TEST(Limits, AZoneThatCutsAnObstacleOnTheMeshsLinesIsRefused) {
  const Overrides cut{{"continuum.cell", "40 mm"},
                      {"obstacles.wall.size", "[40 mm, 90 mm, 80 mm]"},
                      {"grains.zone", "{x: [400 mm, 760 mm], y: [-59 mm, 59 mm]}"}};
  EXPECT_TRUE(holds(refusal(cut), "cuts through obstacles.wall")) << refusal(cut);
}

TEST(Limits, BlocksBetweenPeriodicSidesAreWhole) {
  Overrides changes{{"mode", "continuum"},       {"boundaries.left", "periodic"}, {"boundaries.right", "periodic"},
                    {"terrain.width", "720 mm"}, {"continuum.adapt.levels", "2"}, {"continuum.block", "20"}};
  const std::string why = refusal(changes);
  EXPECT_TRUE(holds(why, "144 cells between periodic sides") && holds(why, "continuum.block: 16 would do")) << why;
  changes.back().second = "16";
  EXPECT_EQ(refusal(changes), "");
}

TEST(Limits, GrainsAreCountable) {
  const std::string why = refusal({{"grains.diameter", "0.00001 mm"}});
  EXPECT_TRUE(holds(why, "grains.diameter is 1e-05 mm") && holds(why, "use larger grains")) << why;
}

TEST(Limits, MoreMemoryThanTheMachineHasIsRefusedByTheRunAndWarnedOfByThePlan) {
  const Scene s = experiment("chiou_wall");
  Plan plan = make_plan(s);
  EXPECT_NO_THROW(check_memory(s, plan));
  plan.memory = 0.4 * machine_memory();
  EXPECT_NO_THROW(check_memory(s, plan, 2));
  try {
    check_memory(s, plan, 3);
    FAIL() << "each rank holds all";
  } catch (const SceneError& error) {
    EXPECT_TRUE(holds(error.what(), "on each of 3 ranks") && holds(error.what(), "or fewer ranks")) << error.what();
  }
  plan.memory = 2 * machine_memory();
  EXPECT_THROW(check_memory(s, plan), SceneError);
  EXPECT_GT(machine_memory(), 1e8);
}

}  // namespace
}  // namespace couloir
