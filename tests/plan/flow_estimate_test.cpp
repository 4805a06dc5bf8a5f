#include "coupling/plan/flow_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plan_scenes.hpp"

namespace couloir {
namespace {

TEST(FlowEstimate, FollowsTheEnergyLineDownTheIncline) {
  const Scene s = experiment("chiou_wall");
  const double m = 9.81 * (std::sin(s.terrain.angle) - std::tan(s.material.delta) * std::cos(s.terrain.angle));
  const FlowEstimate wall = flow_estimate_at(s, 0.65);
  EXPECT_NEAR(wall.velocity, std::sqrt(2 * m * (wall.x - 0.258)), 1e-9);
  EXPECT_NEAR(wall.time, std::sqrt(2 * (wall.x - 0.258) / m), 1e-6);
  EXPECT_LT(wall.depth, 0.0537);
  EXPECT_GT(wall.depth, 0.001);
  EXPECT_NEAR(wall.froude, wall.velocity / std::sqrt(9.81 * std::cos(s.terrain.angle) * wall.depth), 1e-9);
}

TEST(FlowEstimate, UniformFlowStaysAsItIs) {
  for (const FlowEstimate& f : flow_estimate(experiment("null_zone"))) {
    EXPECT_NEAR(f.velocity, 1.002, 1e-4);
    EXPECT_NEAR(f.depth, 0.04, 1e-5);
    EXPECT_NEAR(f.froude, 1.66, 1e-3);
  }
}

TEST(FlowEstimate, EndsWhereTheFlowStops) {
  Scene s = experiment("chiou_wall");
  s.terrain.angle = 0.2;  // below delta
  const auto line = flow_estimate(s);
  ASSERT_EQ(line.size(), 1u);
  EXPECT_EQ(line[0].velocity, 0);
  EXPECT_EQ(flow_estimate_at(s, 1).x, line[0].x);
}

}  // namespace
}  // namespace couloir
