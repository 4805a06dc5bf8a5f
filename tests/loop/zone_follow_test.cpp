// Zones that follow the need, on tests/scenes/channel_wall.yaml.

#include <gmock/gmock.h>

#include "small_run.hpp"

namespace couloir {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

Scene channel(Overrides more = {}) {
  return read_scene(COULOIR_SOURCE_DIR "/tests/scenes/channel_wall.yaml", COULOIR_SOURCE_DIR "/dem_inputs/materials", more);
}

double impulse(const Watched& run) {
  double sum = 0;
  for (const WindowReport& w : run.windows) sum += w.obstacles[0].force[0] * w.length;
  return sum;
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
  EXPECT_NEAR(impulse(run) / impulse(fixed), 1, 0.1);
  EXPECT_LT(run.end.particle_steps, fixed.end.particle_steps * 1.5);
}

// A second flow comes when the first has come to rest.
TEST(ZoneFollow, WakesWhenFlowComesAgain) {
  const Watched run = watch(
      channel({{"release", "{kind: block, position: [150 mm, 0], length: 100 mm, width: 60 mm, height: 24 mm, velocity: 1 m/s}"},
               {"boundaries.upstream", "{inflow: {hydrograph: [[0.55, 15 mm, 0.8], [0.75, 15 mm, 0.8], [0.76, 0 mm, 0.8]]}}"},
               {"duration", "1.4 s"}}),
      options_in(fresh_folder("wake")));
  ASSERT_EQ(run.end.status, "done");
  EXPECT_THAT(run.events, Contains(Field(&Event::what, HasSubstr("grains rest"))));
  EXPECT_THAT(run.events, Contains(Field(&Event::what, HasSubstr("grains wake: flow comes in again"))));
  for (const WindowReport& w : run.windows) EXPECT_LT(w.mass.relative_error(), 1e-12) << w.time;
}

TEST(SeveralZones, EachObstacleHasItsOwnEngine) {
  const Scene scene = small_scene("coupled", {{"terrain.length", "1.3 m"},
                                              {"grains.zone", "auto"},
                                              {"obstacles.wall.size", "[10 mm, 60 mm, 20 mm]"},
                                              {"obstacles.post", "{position: [1.1 m, 0], size: [10 mm, 40 mm, 20 mm]}"},
                                              {"duration", "0.5 s"}});
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

}  // namespace
}  // namespace couloir
