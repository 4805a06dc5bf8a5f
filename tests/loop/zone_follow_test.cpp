// Zones that follow the need, on tests/scenes/channel_wall.yaml.

#include <gmock/gmock.h>

#include <algorithm>

#include "small_run.hpp"

namespace couloir {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

Scene channel(Overrides more = {}) {
  return read_scene(COULOIR_SOURCE_DIR "/tests/scenes/channel_wall.yaml", COULOIR_SOURCE_DIR "/dem_inputs/materials", more);
}

// How much more the material lost along the slope than the wall took, over what the wall took: what the faces did not pass on.
double lost_at_faces(const Watched& run) {
  double wall = 0, lost = 0;
  for (const WindowReport& w : run.windows) {
    wall += w.momentum.to_obstacles();
    lost += w.momentum.lost_to_obstacles() - w.momentum.to_obstacles();
  }
  return lost / wall;
}

TEST(ZoneFollow, GrowsUnderAJumpAndEndsAtRest) {
  const Watched run = watch(channel(), options_in(fresh_folder("follow")));
  ASSERT_EQ(run.end.status, "done");
  EXPECT_THAT(run.events, Contains(Field(&Event::what, HasSubstr("zone grows upstream to x "))));
  EXPECT_THAT(run.events, Contains(Field(&Event::what, HasSubstr("grains rest: no flow comes in"))));
  for (const WindowReport& w : run.windows) {
    EXPECT_LT(w.mass.relative_error(), 1e-12) << w.time;
    EXPECT_TRUE(std::isfinite(w.momentum.residual)) << w.time;
  }
  const WindowReport& last = run.windows.back();
  EXPECT_EQ(last.mass.grains, 0) << "deposit of the continuum";
  EXPECT_EQ(last.grains, 0);
  // At rest what gravity pulls along the slope, wall and bed hold; the wall's share keeps the value that it had.
  EXPECT_LT(std::abs(last.momentum.residual), 0.05 * std::abs(last.momentum.gravity));
  EXPECT_GT(last.obstacles[0].force[0], 0.1 * last.momentum.gravity / last.length);

  const Watched fixed = watch(channel({{"grains.follow", "off"}}), options_in(fresh_folder("fixed")));
  EXPECT_THAT(fixed.events, Not(Contains(Field(&Event::what, HasSubstr("zone grows")))));
  EXPECT_GT(fixed.windows.back().grains, 0);
  // The jump reaches the face of a zone that stays: a tenth of the momentum is lost there.
  EXPECT_LT(std::abs(lost_at_faces(run)), 0.02);
  EXPECT_GT(std::abs(lost_at_faces(fixed)), 3 * std::abs(lost_at_faces(run)));
}

// A second flow comes when the first has come to rest.
TEST(ZoneFollow, WakesWhenFlowComesAgain) {
  const Watched run = watch(
      channel({{"release", "{kind: block, position: [150 mm, 0], length: 100 mm, width: 60 mm, height: 24 mm, velocity: 1 m/s}"},
               {"boundaries.upstream",
                "{inflow: {kind: hydrograph, hydrograph: [[0.7 s, 15 mm, 0.8 m/s], [0.9 s, 15 mm, 0.8 m/s], [0.91 s, 0 mm, 0.8 "
                "m/s]]}}"},
               {"duration", "1.6 s"}}),
      options_in(fresh_folder("wake")));
  ASSERT_EQ(run.end.status, "done");
  EXPECT_THAT(run.events, Contains(Field(&Event::what, HasSubstr("grains rest"))));
  EXPECT_THAT(run.events, Contains(Field(&Event::what, HasSubstr("grains wake: flow comes in again"))));
  for (const WindowReport& w : run.windows) EXPECT_LT(w.mass.relative_error(), 1e-12) << w.time;
  const auto woken =
      std::ranges::find_if(run.events, [](const Event& e) { return e.what.find("grains wake") != std::string::npos; });
  double before = 0, most = 0, overlap = 0;  // [kg] of grains, [-]
  for (const WindowReport& w : run.windows) {
    if (w.time <= woken->time) before = w.mass.continuum;
    if (w.time > woken->time) most = std::max(most, w.mass.grains), overlap = std::max(overlap, w.max_overlap);
  }
  EXPECT_GT(most, 0.1 * before) << "what comes after it has woken becomes grains";
  EXPECT_LT(overlap, 0.1) << "none is laid into another";
}

// Two surges of the same mass, a pause between them: both become grains, the second not laid into what the first left in the
// layer.
TEST(ZoneFollow, TakesASecondSurgeAsTheFirst) {
  const Watched run = watch(
      channel(
          {{"release", "{kind: none}"},
           {"obstacles", "{}"},
           {"terrain.length", "900 mm"},
           {"boundaries.upstream",
            "{inflow: {kind: hydrograph, hydrograph: [[0 s, 15 mm, 0.8 m/s], [0.1 s, 15 mm, 0.8 m/s], [0.101 s, 0 mm, 0.8 m/s], "
            "[0.3 s, 0 mm, 0.8 m/s], [0.301 s, 15 mm, 0.8 m/s], [0.401 s, 15 mm, 0.8 m/s], [0.402 s, 0 mm, 0.8 m/s]]}}"},
           {"grains.diameter", "8 mm"},
           {"grains.follow", "off"},
           {"duration", "0.95 s"}}),
      options_in(fresh_folder("surges")));
  ASSERT_EQ(run.end.status, "done");
  double first = 0, second = 0;  // [kg] most that was in the zone
  for (const WindowReport& w : run.windows) {
    EXPECT_LT(w.mass.relative_error(), 1e-12) << w.time;
    EXPECT_LT(w.max_overlap, 0.1) << w.time;
    double& most = w.time < 0.63 ? first : second;
    most = std::max(most, w.mass.grains);
  }
  std::printf("in the zone: %.4f kg of the first surge, %.4f kg of the second\n", first, second);
  EXPECT_GT(first, 0.02);
  EXPECT_NEAR(second / first, 1, 0.15);
}

class SeveralZones : public testing::TestWithParam<Overrides> {};

TEST_P(SeveralZones, EachObstacleHasItsOwnEngine) {
  Overrides zones = GetParam();
  const Scene scene = small_scene("coupled", {{"terrain.length", "1.3 m"},
                                              zones[0],
                                              zones[1],
                                              {"obstacles.wall.size", "[10 mm, 60 mm, 20 mm]"},
                                              {"obstacles.post", "{position: [1.1 m, 0], size: [10 mm, 40 mm, 20 mm]}"},
                                              {"duration", "0.75 s"}});
  const Watched run = watch(scene, options_in(fresh_folder("two_zones")));
  ASSERT_EQ(run.end.status, "done");
  long starts = 0;
  for (const Event& e : run.events) starts += e.what.find("grains start") != std::string::npos;
  EXPECT_EQ(starts, 2);
  double wall = 0, post = 0;
  for (const WindowReport& w : run.windows) {
    EXPECT_LT(w.mass.relative_error(), 1e-12) << w.time;
    wall += w.obstacles[0].force[0] * w.length, post += w.obstacles[1].force[0] * w.length;
  }
  EXPECT_GT(wall, 0);
  EXPECT_GT(post, 0);
}

INSTANTIATE_TEST_SUITE_P(Are, SeveralZones,
                         testing::Values(Overrides{{"grains.zone", "auto"}, {"grains.zones", "[]"}},
                                         Overrides{
                                             {"grains.zone", "auto"},
                                             {"grains.zones",
                                              "[{x: [0.27 m, 0.5 m], y: [-60 mm, 60 mm]}, {x: [0.97 m, 1.2 m], y: [-60 mm, 60 "
                                              "mm]}]"}}));

}  // namespace
}  // namespace couloir
