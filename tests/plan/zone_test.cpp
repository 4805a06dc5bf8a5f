#include "coupling/plan/zone.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/scene/scene_error.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

TEST(AutomaticZone, HoldsTheWallWithRoom) {
  const Scene s = experiment("chiou_wall");
  const ZoneBox z = automatic_zone(s);
  const double d = s.grains.diameter, H = 0.08;
  EXPECT_LE(z.x0, 0.65 - std::max(2 * H, 30 * d) + 1e-9);
  EXPECT_GE(z.x0, 0.258 + 0.158 - 1e-9) << "not in the release";
  EXPECT_GE(z.x1, 0.66 + std::max(0.25 * H, 5 * d) - 1e-9);
  EXPECT_LE(z.y0, -0.08 - std::max(0.3 * H, 8 * d) + 1e-9);
  EXPECT_EQ(z.y0, -z.y1);
  EXPECT_GT(z.y0, -0.4) << "not the whole width";
}

TEST(AutomaticZone, LiesOnCellLines) {
  const Scene s = experiment("chiou_wall");
  const PlannedZone zone = planned_zone(s);
  const Grid g = grid_of(s);
  EXPECT_DOUBLE_EQ(zone.box.x0, g.x0 + zone.cells.i0 * g.dx);
  EXPECT_DOUBLE_EQ(zone.box.y1, g.y0 + zone.cells.j1 * g.dy);
  EXPECT_EQ(zone.cells.j0 + zone.cells.j1, g.ny) << "symmetric about y = 0";
  EXPECT_NE(zone.reason.find("wall is 80 mm high"), std::string::npos) << zone.reason;
  EXPECT_NE(zone.reason.find("Fr "), std::string::npos) << zone.reason;
}

TEST(AutomaticZone, GrowsWithWallAndGrains) {
  const ZoneBox base = automatic_zone(experiment("chiou_wall"));
  const ZoneBox low = automatic_zone(experiment("chiou_wall", {{"obstacles.wall.size", "[10 mm, 160 mm, 40 mm]"}}));
  const ZoneBox coarse = automatic_zone(experiment("chiou_wall", {{"grains.diameter", "6 mm"}}));
  EXPECT_GT(low.x0, base.x0);
  EXPECT_GT(coarse.x1, base.x1);
  EXPECT_LT(coarse.y0, base.y0);
}

TEST(AutomaticZone, DoesNotDependOnHowLongTheRunIs) {
  const ZoneBox longer = automatic_zone(experiment("chiou_wall"));
  const ZoneBox shorter = automatic_zone(experiment("chiou_wall", {{"duration", "0.1 s"}}));
  EXPECT_EQ(shorter.x0, longer.x0);
  EXPECT_EQ(shorter.x1, longer.x1);
  EXPECT_EQ(shorter.y0, longer.y0);
}

TEST(AutomaticZone, CoversAllObstaclesAndMeetsNearSides) {
  const Scene s = experiment("chiou_wall", {{"obstacles.post", "{position: [750 mm, 345 mm], size: [20 mm, 20 mm, 60 mm]}"}});
  const ZoneBox z = automatic_zone(s);
  EXPECT_GE(z.x1, 0.77);
  EXPECT_NEAR(z.y1, 0.4, 1e-9) << "moved onto the side";
  EXPECT_LT(z.y0, -0.08);
}

TEST(AutomaticZone, NeedsAnObstacle) {
  Scene s = experiment("chiou_wall");
  s.obstacles.clear();
  EXPECT_THROW(automatic_zone(s), SceneError);
}

TEST(PlannedZone, KeepsTheScenesBox) {
  const PlannedZone zone = planned_zone(experiment("null_zone"));
  EXPECT_EQ(zone.cells.i0, 60);
  EXPECT_EQ(zone.cells.i1, 100);
  EXPECT_EQ(zone.cells.j0, 0);
  EXPECT_EQ(zone.cells.j1, 12);
  EXPECT_NEAR(zone.box.x0, 0.3, 1e-12);
  EXPECT_NEAR(zone.box.y1, 0.03, 1e-12);
}

}  // namespace
}  // namespace couloir
