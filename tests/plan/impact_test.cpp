#include "coupling/plan/impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/plan/plan.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

TEST(Impact, IsTheMomentumThatTheFaceTakesUpAndTheHydrostaticPressure) {
  EXPECT_DOUBLE_EQ(dynamic_force(1500, 2, 0.1, 0.5, std::numbers::pi / 2), 1500 * 4 * 0.1 * 0.5);
  EXPECT_NEAR(dynamic_force(1500, 2, 0.1, 0.5, std::numbers::pi / 6), 1500 * 4 * 0.1 * 0.5 / 4, 1e-12);
  EXPECT_DOUBLE_EQ(hydrostatic_force(1500, 8, 0.1, 0.5), 1500 * 8 * 0.005 * 0.5);
}

TEST(Impact, TakesWhatTheEnergyLineBringsToTheObstacle) {
  const Scene s = experiment("chiou_wall");
  const ObstacleSpec& o = s.obstacles[0];
  const auto all = impact_estimates(s);
  ASSERT_EQ(all.size(), 1u);
  const FlowEstimate flow = flow_estimate_at(s, o.x);
  EXPECT_EQ(all[0].obstacle, o.name);
  EXPECT_EQ(all[0].velocity, flow.velocity);
  EXPECT_LT(all[0].arrival, flow.time) << "the front comes before the middle";
  EXPECT_GT(all[0].arrival, 0);
  const double depth = std::min(flow.depth, o.height), width = std::min(o.width, flow.width);
  EXPECT_DOUBLE_EQ(all[0].force(), dynamic_force(s.material.density, flow.velocity, depth, width, std::numbers::pi / 2) +
                                       hydrostatic_force(s.material.density, 9.81 * std::cos(s.terrain.angle), depth, width));
}

TEST(Impact, ALowObstacleTakesUpNoMoreThanItsHeight) {
  Scene s = experiment("chiou_wall");
  const double full = impact_estimates(s)[0].dynamic;
  s.obstacles[0].height = flow_estimate_at(s, s.obstacles[0].x).depth / 4;
  EXPECT_NEAR(impact_estimates(s)[0].dynamic, full / 4, 1e-12);
}

TEST(Impact, OfNothingThatTheFlowDoesNotGetTo) {
  Scene s = experiment("chiou_wall");
  s.duration = 0.05;
  EXPECT_TRUE(impact_estimates(s).empty()) << "the run ends before";
  s = experiment("chiou_wall");
  s.terrain.angle = 0.2;  // below delta: friction holds it
  EXPECT_TRUE(impact_estimates(s).empty());
  ASSERT_TRUE(run_out(flow_estimate(s)));
}

TEST(Impact, APlanShowsItWithWhatItIsWorth) {
  const Scene s = experiment("chiou_wall");
  const Plan plan = make_plan(s);
  const std::string text = plan_text(plan);
  EXPECT_NE(text.find("estimate   wall: front after "), std::string::npos) << text;
  EXPECT_NE(text.find("nothing solved: times and speeds within a half, forces within a factor of three"), std::string::npos);
  EXPECT_DOUBLE_EQ(plan_json(plan)["estimate"]["obstacles"]["wall"]["force"].get<double>(), impact_estimates(s)[0].force());
}

}  // namespace
}  // namespace couloir
