#include "continuum/noc/slopes.hpp"

#include <gtest/gtest.h>

#include "continuum/noc/terrain.hpp"
#include "tests/continuum/scenes.hpp"

namespace couloir::test {
namespace {

TEST(NocSlopes, TvdTakesTheTwoNeighbours) {
  const double w[] = {9, 1, 2, 5, -7};
  EXPECT_EQ(noc::SlopeTvd<LimiterMinmod>::slope(w + 2, 1), 1);
  EXPECT_EQ(noc::SlopeTvd<LimiterVanLeer>::slope(w + 2, 1), 1.5);
  EXPECT_EQ(noc::SlopeTvd<LimiterSuperbee>::slope(w + 2, 1), 2);
}

// A parabola's slope is exact, its extremum's too; TVD slopes are neither.
TEST(NocSlopes, EnoIsExactForParabolas) {
  const auto parabola = [](double x) { return 3 * x * x - 2 * x; };
  for (int at : {-3, 0, 4}) {
    double w[5];
    for (int k = 0; k < 5; ++k) w[k] = parabola(at + k - 2);
    EXPECT_DOUBLE_EQ(noc::SlopeEno::slope(w + 2, 1), 6 * at - 2) << at;
  }
}

TEST(NocSlopes, EnoKeepsTheSmallerSideAtAJump) {
  const double step[] = {0, 0, 0, 1, 1};
  EXPECT_EQ(noc::SlopeEno::slope(step + 2, 1), 0);
}

// A block with flanks one cell wide: the rise is found whatever the grid, at the quarter points of the flank alone.
TEST(NocTerrain, FlanksAreSeenAtTheQuarterPoints) {
  const Grid g{20, 4, 0.1, 0.1, 0, -0.2};
  NocBed bed;
  bed.obstacles.push_back([](double x, double) { return std::clamp(std::min(x - 0.5, 1.2 - x) / 0.1, 0.0, 1.0) * 2.4; });
  const noc::Terrain t(g, ReferenceSurface::incline(degrees(40), 2), bed, 9.81, false);
  for (int k = 0; k < 40; ++k) {
    const double expected = k == 10 || k == 11 ? 24 : k == 22 || k == 23 ? -24 : 0;
    EXPECT_NEAR(t.slope(k, 3).x, expected, 1e-11) << k;
    EXPECT_NEAR(t.slope(k, 3).y, 0, 1e-12);
  }
  NocBed wall;  // a flank narrower than a quadrant
  wall.obstacles.push_back([](double x, double) { return x > 0.513 ? 1.0 : 0.0; });
  const noc::Terrain thin(g, ReferenceSurface::incline(degrees(40), 2), wall, 9.81, false);
  double rise = 0;
  for (int k = 0; k < 40; ++k) rise += thin.slope(k, 0).x * 0.05;
  EXPECT_NEAR(rise, 1, 1e-12);
}

}  // namespace
}  // namespace couloir::test
