// Planes in a run: what the user is told of overflow, and which scenes are refused.

#include <gmock/gmock.h>

#include "continuum/errors.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/scene/scene_error.hpp"
#include "tests/loop/small_run.hpp"

namespace couloir {
namespace {

using testing::HasSubstr;

Scene planes_scene(Overrides more = {}) {
  more.push_back({"obstacles.wall.method", "planes"});
  return small_scene("continuum", more);
}

std::string refusal(const std::string& mode, Overrides more) {
  try {
    small_scene(mode, more);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(PlanesRun, ReportsOverflowWithItsMass) {
  const Watched run = watch(planes_scene({{"obstacles.wall.eta", "1"}}), options_in(fresh_folder("planes_overflow")));
  ASSERT_EQ(run.end.status, "done");
  const WindowReport& last = run.windows.back();
  const double overflow = last.obstacles[0].overflow;
  EXPECT_GT(overflow, 1e-3 * last.mass.initial);
  EXPECT_EQ(last.overtopped, overflow);
  ASSERT_FALSE(run.events.empty());
  EXPECT_THAT(run.events.back().what, HasSubstr("came over the upper edges of wall, which method planes cannot describe"));
  char mass[32];
  std::snprintf(mass, sizeof mass, "in all, %.4g kg", overflow);
  EXPECT_THAT(run.events.back().what, HasSubstr(mass));
  for (const WindowReport& w : run.windows) {
    EXPECT_LE(w.mass.relative_error(), 1e-12);
    EXPECT_LE(std::abs(w.momentum.residual), 1e-12 * std::max(w.momentum.scale, 1e-9));
  }
}

TEST(PlanesRun, IsSilentWhereNothingComesOver) {
  const Watched run = watch(planes_scene({{"obstacles.wall.eta", "0.2"}, {"obstacles.wall.size", "[10 mm, 60 mm, 200 mm]"}}),
                            options_in(fresh_folder("planes_below")));
  EXPECT_EQ(run.windows.back().obstacles[0].overflow, 0);
  EXPECT_GT(run.windows.back().obstacles[0].heap, 0);
  EXPECT_TRUE(run.events.empty());
}

TEST(PlanesRun, EndsOnOverflowWhereTheSceneSaysSo) {
  const Scene scene = planes_scene({{"obstacles.wall.eta", "1"}, {"obstacles.wall.overflow", "error"}});
  const RunOptions options = options_in(fresh_folder("planes_error"));
  Watched watched;
  EXPECT_THROW(run_scene(scene, options, {&watched}), NumericsError);
  EXPECT_EQ(watched.end.status, "failed");
  EXPECT_THAT(watched.end.reason, HasSubstr("came over the upper edges of wall"));
}

TEST(PlanesRun, SaysThatAHeapOutgrowsTheWall) {
  const Watched run = watch(planes_scene({{"obstacles.wall.eta", "0"}, {"obstacles.wall.size", "[10 mm, 180 mm, 20 mm]"}}),
                            options_in(fresh_folder("planes_heap")));
  ASSERT_FALSE(run.events.empty());
  EXPECT_THAT(run.events.front().what, HasSubstr("the heap on the slope before wall stands"));
}

// Mode coupled has a solid body instead, and the plan says so.
TEST(PlanesRun, ThePlanNamesWhatStandsThere) {
  const auto reason = [](const char* mode, const char* name) {
    for (const Effect& e :
         make_plan(small_scene(mode, {{"obstacles.wall.method", "planes"}, {"obstacles.wall.eta", "0.7"}})).effects)
      if (e.name == name) return e.reason;
    return std::string();
  };
  EXPECT_THAT(reason("continuum", "planes"), HasSubstr("five planes: wall (40 mm high), eta 0.7"));
  EXPECT_THAT(reason("coupled", "planes"), HasSubstr("grains of the zone meet the obstacles as solid bodies"));
  EXPECT_THAT(reason("coupled", "solid_bodies"), HasSubstr("wall"));
}

TEST(PlanesRun, ScenesThatAreRefused) {
  const Overrides planes = {{"obstacles.wall.method", "planes"}};
  EXPECT_EQ(refusal("continuum", planes), "");
  EXPECT_EQ(refusal("grains", planes), "");
  EXPECT_EQ(refusal("coupled", planes), "") << "grains hold the obstacle";
  EXPECT_THAT(refusal("continuum", {{"obstacles.wall.method", "planes"}, {"obstacles.wall.eta", "1.1"}}),
              HasSubstr("obstacles.wall.eta is 1.1"));
  EXPECT_THAT(refusal("continuum", {{"obstacles.wall.eta", "0.5"}}), HasSubstr("does not belong to method 'step'"));
  EXPECT_THAT(refusal("continuum", {{"obstacles.wall.method", "planes"},
                                    {"obstacles.post", "{position: [500 mm, 0], size: [20 mm, 20 mm, 20 mm], method: planes}"}}),
              HasSubstr("one a scene"));
  EXPECT_THAT(refusal("continuum", {{"obstacles.wall.method", "planes"},
                                    {"obstacles.wall.size", "[10 mm, 200 mm, 40 mm]"},
                                    {"boundaries.left", "periodic"},
                                    {"boundaries.right", "periodic"}}),
              HasSubstr("reaches a periodic side"));
  EXPECT_THAT(refusal("continuum", {{"obstacles.wall.method", "planes"}, {"continuum.scheme", "noc"}}),
              HasSubstr("is planes, which scheme noc does not have; use continuum.scheme: central_upwind"));
  EXPECT_THAT(refusal("coupled", {{"obstacles.post", "{position: [520 mm, 0], size: [20 mm, 20 mm, 20 mm], method: planes}"}}),
              HasSubstr("only where grains hold the obstacle"));
}

}  // namespace
}  // namespace couloir
