#include "coupling/plan/validity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/plan/plan.hpp"
#include "coupling/scene/reader.hpp"

namespace couloir {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Scene wall_scene(Overrides more = {}) {
  return read_scene(COULOIR_SOURCE_DIR "/experiments/chiou_wall", COULOIR_SOURCE_DIR "/dem_inputs/materials", more);
}

// On the run-out, 5 mm high, rising within 250 mm: 1.1 deg.
const Overrides mound{
    {"grains.diameter", "2 mm"},
    {"obstacles.mound", "{position: [1.15 m, 0], size: [600 mm, 600 mm, 5 mm], method: elevation, ramp: 250 mm}"}};

TEST(ShallowModel, FailsAtAWallByEachNumber) {
  const Scene scene = wall_scene();
  const ShallowVerdict v = shallow_verdict(scene, scene.obstacles[0]);
  const FlowEstimate flow = flow_estimate_at(scene, 0.65);
  EXPECT_FALSE(v.holds());
  ASSERT_EQ(v.tests.size(), 5u);
  EXPECT_NEAR(v.tests[0].value, 1.5707963, 1e-6);
  EXPECT_NEAR(v.tests[1].value, 1.5707963, 1e-6) << "turned by a right angle within a depth";
  EXPECT_NEAR(v.tests[2].value, v.tests[1].value * flow.froude * flow.froude, 1e-6);
  // Mass and momentum across a jump: h1 u1 = h2 u2 as seen from it, h1 u1^2 + g h1^2 / 2 = h2 u2^2 + g h2^2 / 2.
  const double r = v.tests[3].value, fr2 = flow.froude * flow.froude;
  EXPECT_NEAR(fr2 + 0.5, fr2 / r + 0.5 * r * r, 1e-9 * fr2);
  EXPECT_NEAR(v.tests[4].value, flow.depth / 0.004, 1e-12);
  EXPECT_THAT(v.sentence(),
              StartsWith("fails at wall: slope of its front 90 deg, limit 45 deg; curvature times depth 1.6, limit 0.3; "));
}

TEST(ShallowModel, HoldsAtAMoundAndOnTheArc) {
  const auto verdicts = shallow_verdicts(wall_scene(mound));
  ASSERT_EQ(verdicts.size(), 4u);
  const ShallowVerdict& low = verdicts[0].place == "mound" ? verdicts[0] : verdicts[1];
  EXPECT_TRUE(low.holds()) << low.sentence();
  EXPECT_THAT(low.sentence(), HasSubstr("; but depth over diameter ")) << "told, and no reason for grains";
  EXPECT_EQ(verdicts[2].place, "arc");
  EXPECT_TRUE(verdicts[2].holds()) << verdicts[2].sentence();
  EXPECT_NEAR(verdicts[2].tests[0].value, 40 * 3.14159265 / 180 / 0.1465 * flow_estimate_at(wall_scene(), 0.9335).depth, 1e-6);
}

TEST(ShallowModel, AJumpIsNoHigherThanItsObstacleLetsItBe) {
  const Scene scene = wall_scene({{"grains.diameter", "2 mm"}, {"obstacles.wall.size", "[10 mm, 160 mm, 5 mm]"}});
  const ShallowVerdict v = shallow_verdict(scene, scene.obstacles[0]);
  EXPECT_NEAR(v.tests[3].value, 1 + 0.005 / flow_estimate_at(scene, 0.65).depth, 1e-12);
}

TEST(ShallowModel, FailsWhereATallColumnIsReleased) {
  EXPECT_TRUE(shallow_verdicts(wall_scene()).back().holds()) << "a cap of 60 mm on 316 mm";
  const Scene flume =
      read_scene(COULOIR_SOURCE_DIR "/experiments/moriguchi_flume", COULOIR_SOURCE_DIR "/dem_inputs/materials", {});
  EXPECT_EQ(shallow_verdicts(flume).back().sentence(), "fails at the release: depth over length 0.74, limit 0.5");
}

TEST(ShallowModel, TellsWhereGrainsAreCalledFor) {
  const Plan both = make_plan(wall_scene(mound));
  ASSERT_EQ(both.zones.size(), 1u);
  EXPECT_THAT(both.zones[0].reason, HasSubstr("wall is"));
  EXPECT_THAT(both.zones[0].reason, Not(HasSubstr("mound is")));
  EXPECT_THAT(
      both.warnings,
      Contains(HasSubstr("mound lies outside the zone: the continuum flows around it, as the shallow model holds there.")));
  EXPECT_THAT(plan_text(both), HasSubstr("shallow    "));
  EXPECT_THAT(plan_text(both), HasSubstr("fails at wall: "));
  EXPECT_EQ(plan_json(both)["shallow"].size(), 4u);

  Overrides alone = mound;
  alone.emplace_back("obstacles.wall", "{position: [450 mm, 0], size: [300 mm, 400 mm, 4 mm], method: elevation, ramp: 150 mm}");
  const Plan none = make_plan(wall_scene(alone));
  EXPECT_THAT(none.warnings, Contains(HasSubstr("The shallow model holds at every obstacle: mode continuum would do.")));
  EXPECT_FALSE(none.zones.empty());
}

// 35 deg, then a brink of radius 0.2 m / 0.35, which a flow of 1.4 m/s or more leaves.
TEST(ShallowModel, FailsOverABrinkThatTheFlowWouldLeave) {
  const Scene scene = wall_scene({{"terrain",
                                   "{kind: profile, width: 400 mm, profile: [[0, 30 deg], [0.9 m, 30 deg], [1.1 m, 50 deg], "
                                   "[1.5 m, 50 deg], [1.8 m, 20 deg], [2 m, 20 deg]]}"}});
  const auto verdicts = shallow_verdicts(scene);
  std::vector<std::string> places;
  for (const ShallowVerdict& v : verdicts) places.push_back(v.place);
  ASSERT_THAT(places, testing::IsSupersetOf({"arc at 900 mm", "arc at 1.5 m"}));
  const auto& brink = *std::ranges::find(verdicts, "arc at 900 mm", &ShallowVerdict::place);
  const FlowEstimate flow = flow_estimate_at(scene, 1.1);  // its end, where it is fastest and steepest
  const double degree = 3.14159265358979 / 180;
  EXPECT_EQ(brink.tests[1].name, "lift over weight");
  EXPECT_NEAR(brink.tests[1].value, 20 * degree / 0.2 * flow.velocity * flow.velocity / (9.81 * std::cos(50 * degree)),
              0.02 * brink.tests[1].value);
  EXPECT_EQ(brink.tests[1].holds, brink.tests[1].value <= 1);
}

}  // namespace
}  // namespace couloir
