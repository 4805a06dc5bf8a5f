#include "coupling/plan/zone.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/plan/switches.hpp"
#include "coupling/scene/scene_error.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

PlannedZone the_zone(const Scene& s) {
  const std::vector<PlannedZone> zones = planned_zones(s);
  EXPECT_EQ(zones.size(), 1u);
  return zones.front();
}
ZoneBox automatic(const Scene& s) {
  return the_zone(s).box;
}

TEST(AutomaticZone, HoldsTheWallWithRoom) {
  const Scene s = experiment("chiou_wall");
  const ZoneBox z = automatic(s);
  const double d = s.grains.diameter, H = 0.08;
  EXPECT_LE(z.x0, 0.65 - std::max(2 * H, 30 * d) + 1e-9);
  EXPECT_GE(z.x0, 0.258 + 0.158 - 1e-9) << "not in the release";
  EXPECT_GE(z.x1, 0.66 + std::max(0.25 * H, 5 * d) - 1e-9);
  EXPECT_LE(z.y0, -0.08 - std::max(0.3 * H, 8 * d) + 1e-9);
  EXPECT_EQ(z.y0, -z.y1);
  EXPECT_GT(z.y0, -0.4) << "not the whole width";
}

// No key of the continuum has a say: a scheme without zones, cells that follow.
TEST(ZoneOfGrainsAlone, IsAllButTheStripOfAnInflow) {
  const Scene s = experiment("chiou_wall", {{"mode", "grains"},
                                            {"boundaries.upstream", "{inflow: {depth: 0.04 m, velocity: 1 m/s}}"},
                                            {"continuum.adapt.levels", "2"}});
  EXPECT_TRUE(has_zones(s));
  EXPECT_FALSE(has_zones(experiment("chiou_wall", {{"mode", "grains"}})));
  const PlannedZone zone = the_zone(s);
  const Grid g = grid_of(s);
  EXPECT_EQ(zone.cells.i0, std::max(4, int(std::ceil(4 * s.grains.diameter / g.dx))));
  EXPECT_EQ(zone.cells.i1, g.nx);
  EXPECT_EQ(zone.cells.j0, 0);
  EXPECT_EQ(zone.cells.j1, g.ny);
  EXPECT_EQ(zone.lines.x.size(), 2u) << "it does not grow";
  EXPECT_EQ(as_run(s).continuum.adapt.levels, 0);
}

TEST(ZoneOfGrainsAlone, RefusesAnObstacleInTheStrip) {
  const Scene s = experiment("chiou_wall", {{"mode", "grains"},
                                            {"release", "{kind: none}"},
                                            {"boundaries.upstream", "{inflow: {depth: 0.04 m, velocity: 1 m/s}}"},
                                            {"obstacles.wall.position", "[12 mm, 0]"}});
  EXPECT_THAT([&] { make_plan(s); },
              testing::ThrowsMessage<SceneError>(testing::HasSubstr("obstacles.wall stands in the strip along a side")));
}

TEST(AutomaticZone, LiesOnCellLines) {
  const Scene s = experiment("chiou_wall");
  const PlannedZone zone = the_zone(s);
  const Grid g = grid_of(s);
  EXPECT_DOUBLE_EQ(zone.box.x0, g.x0 + zone.cells.i0 * g.dx);
  EXPECT_DOUBLE_EQ(zone.box.y1, g.y0 + zone.cells.j1 * g.dy);
  EXPECT_EQ(zone.cells.j0 + zone.cells.j1, g.ny) << "symmetric about y = 0";
  EXPECT_NE(zone.reason.find("wall is 80 mm high"), std::string::npos) << zone.reason;
  EXPECT_NE(zone.reason.find("Fr "), std::string::npos) << zone.reason;
}

TEST(AutomaticZone, GrowsWithWallAndGrains) {
  const ZoneBox base = automatic(experiment("chiou_wall"));
  const ZoneBox low = automatic(experiment("chiou_wall", {{"obstacles.wall.size", "[10 mm, 160 mm, 40 mm]"}}));
  const ZoneBox coarse = automatic(experiment("chiou_wall", {{"grains.diameter", "6 mm"}}));
  EXPECT_GT(low.x0, base.x0);
  EXPECT_GT(coarse.x1, base.x1);
  EXPECT_LT(coarse.y0, base.y0);
}

TEST(AutomaticZone, DoesNotDependOnHowLongTheRunIs) {
  const ZoneBox longer = automatic(experiment("chiou_wall"));
  const ZoneBox shorter = automatic(experiment("chiou_wall", {{"duration", "0.1 s"}}));
  EXPECT_EQ(shorter.x0, longer.x0);
  EXPECT_EQ(shorter.x1, longer.x1);
  EXPECT_EQ(shorter.y0, longer.y0);
}

TEST(AutomaticZone, CoversAllObstaclesAndMeetsNearSides) {
  const Scene s = experiment("chiou_wall", {{"obstacles.post", "{position: [750 mm, 320 mm], size: [20 mm, 120 mm, 60 mm]}"}});
  const ZoneBox z = automatic(s);
  EXPECT_GE(z.x1, 0.77);
  EXPECT_NEAR(z.y1, 0.4, 1e-9) << "moved onto the side";
  EXPECT_LT(z.y0, -0.08);
}

TEST(AutomaticZone, ObstaclesFarApartHaveZonesOfTheirOwn) {
  const Overrides post{{"obstacles.post", "{position: [1.35 m, 0], size: [20 mm, 100 mm, 40 mm]}"}};
  const Scene s = experiment("chiou_wall", post);
  const std::vector<PlannedZone> zones = planned_zones(s);
  ASSERT_EQ(zones.size(), 2u);
  EXPECT_TRUE(zones[0].box.holds(s.obstacles[0]));
  EXPECT_TRUE(zones[1].box.holds(s.obstacles[1]));
  EXPECT_GT(zones[1].box.x0 - zones[0].box.x1, 40 * s.grains.diameter);
  for (int n : {0, 1})
    EXPECT_EQ(zones[std::size_t(n)].reason.find(s.obstacles[std::size_t(1 - n)].name + " is"), std::string::npos);
  const Grid g = grid_of(s);
  const auto widest = [&](const PlannedZone& z) {
    return box_of({z.lines.x.front(), z.lines.x.back(), z.lines.y.front(), z.lines.y.back()}, g);
  };
  EXPECT_GT(widest(zones[1]).x0 - widest(zones[0]).x1, 20 * s.grains.diameter) << "they cannot grow into each other";
}

TEST(ZoneGrowth, HasStepsOnAllSidesWithinTheDomain) {
  const Scene s = experiment("chiou_wall");
  const PlannedZone z = the_zone(s);
  const Grid g = grid_of(s);
  EXPECT_GE(z.lines.at_x, 1);
  EXPECT_EQ(z.lines.at_y, 2);
  EXPECT_EQ(z.lines.x[std::size_t(z.lines.at_x)], z.cells.i0);
  EXPECT_EQ(z.lines.x[std::size_t(z.lines.at_x) + 1], z.cells.i1);
  EXPECT_EQ(z.lines.y.front() + z.lines.y.back(), g.ny) << "symmetric";
  EXPECT_TRUE(std::ranges::is_sorted(z.lines.x));
  EXPECT_GE(z.lines.x.front() * g.dx, 4 * s.grains.diameter) << "room for the driven layer";
  for (std::size_t n = 1; n < z.lines.x.size(); ++n)
    EXPECT_GE((z.lines.x[n] - z.lines.x[n - 1]) * g.dx, 15 * s.grains.diameter - 1e-9);
  const ZoneLines fixed = the_zone(experiment("chiou_wall", {{"grains.follow", "off"}})).lines;
  EXPECT_EQ(fixed.x.size() + fixed.y.size(), 4u);
}

TEST(AutomaticZone, NeedsAnObstacle) {
  Scene s = experiment("chiou_wall");
  s.obstacles.clear();
  EXPECT_THROW(planned_zones(s), SceneError);
}

TEST(PlannedZone, KeepsTheScenesBox) {
  const PlannedZone zone = the_zone(experiment("null_zone"));
  EXPECT_EQ(zone.cells.i0, 60);
  EXPECT_EQ(zone.cells.i1, 100);
  EXPECT_EQ(zone.cells.j0, 0);
  EXPECT_EQ(zone.cells.j1, 12);
  EXPECT_NEAR(zone.box.x0, 0.3, 1e-12);
  EXPECT_NEAR(zone.box.y1, 0.03, 1e-12);
}

}  // namespace
}  // namespace couloir
