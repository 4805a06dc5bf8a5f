#include "coupling/plan/release.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/plan/build.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

TEST(Release, CapIsScaledToItsMass) {
  const Scene s = experiment("chiou_wall");
  EXPECT_DOUBLE_EQ(release_volume(s), 1.41 / 639);
  const Grid g = grid_of(s);
  double sum = 0;
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) sum += release_at(s, g.x(i), g.y(j)).h * g.dx * g.dy;
  }
  EXPECT_NEAR(sum / release_volume(s), 1, 2e-3);
  EXPECT_NEAR(release_at(s, 0.258, 0).h, 0.06 * (1.41 / 639) / 2.466e-3, 1e-5);
  EXPECT_EQ(release_at(s, 0.42, 0).h, 0);
}

TEST(Release, WithoutMassTheShapeCounts) {
  Scene s = experiment("chiou_wall");
  s.release.mass = 0;
  EXPECT_NEAR(release_volume(s), 2.466e-3, 0.5e-6);
  EXPECT_DOUBLE_EQ(release_at(s, 0.258, 0).h, 0.06);
}

TEST(Release, UniformFlowMoves) {
  const Scene s = experiment("null_zone");
  const FlowState flow = release_at(s, 0.4, 0.01);
  EXPECT_EQ(flow.h, 0.04);
  EXPECT_DOUBLE_EQ(flow.hu, 0.04 * 1.002);
  EXPECT_EQ(flow.hv, 0);
  EXPECT_DOUBLE_EQ(release_volume(s), 0.04 * 0.8 * 0.06);
  EXPECT_NEAR(flow.hu / flow.h / std::sqrt(9.81 * std::cos(s.terrain.angle) * 0.04), 1.66, 5e-4);
}

TEST(Release, InsideIsBelowTheSurface) {
  const Scene s = experiment("chiou_wall");
  const double top = release_at(s, 0.3, 0.02).h;
  EXPECT_TRUE(inside_release(s, 0.3, 0.02, 0.999 * top));
  EXPECT_FALSE(inside_release(s, 0.3, 0.02, 1.001 * top));
  EXPECT_FALSE(inside_release(s, 0.3, 0.02, -1e-6));
  EXPECT_FALSE(inside_release(s, 0.6, 0.02, 0));
}

}  // namespace
}  // namespace couloir
