#include "coupling/scene/release_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace couloir {
namespace {

Scene blank() {
  Scene s;
  s.terrain.kind = TerrainSpec::Kind::incline;
  s.terrain.length = 2;
  s.terrain.width = 1;
  s.material.density = 639;
  s.release.x = 0.5;
  return s;
}

// Midpoint sum over the footprint.
double summed(const Scene& s, int n) {
  const Footprint f = release_footprint(s);
  const double dx = (f.x1 - f.x0) / n, dy = (f.y1 - f.y0) / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) sum += shape_depth(s, f.x0 + (i + 0.5) * dx, f.y0 + (j + 0.5) * dy);
  }
  return sum * dx * dy;
}

TEST(ReleaseShape, CapHoldsTheShallowCapsVolume) {
  Scene s = blank();
  s.release.kind = ReleaseSpec::Kind::cap;
  s.release.base_radius = 0.158;
  s.release.height = 0.06;
  EXPECT_NEAR(shape_volume(s), 2.466e-3, 0.5e-6);
  EXPECT_NEAR(summed(s, 800) / shape_volume(s), 1, 1e-4);
  EXPECT_DOUBLE_EQ(shape_depth(s, 0.5, 0), 0.06);
  EXPECT_EQ(shape_depth(s, 0.5 + 0.158, 0), 0);
  s.release.mass = 1.41;
  EXPECT_NEAR(depth_scale(s), 1.41 / 639 / 2.466e-3, 2e-4);
  EXPECT_DOUBLE_EQ(deepest(s), 0.06 * depth_scale(s));
}

TEST(ReleaseShape, EllipsoidHoldsTheSeedsVolume) {
  Scene s = blank();
  s.release.kind = ReleaseSpec::Kind::ellipsoid;
  s.release.semi_x = s.release.semi_y = 4.74 * 0.03333;
  s.release.semi_z = 1.8 * 0.03333;
  EXPECT_NEAR(shape_volume(s), 3.137e-3, 1e-6);
  EXPECT_NEAR(summed(s, 800) / shape_volume(s), 1, 1e-3);
}

TEST(ReleaseShape, BlockAndUniform) {
  Scene s = blank();
  s.release.kind = ReleaseSpec::Kind::block;
  s.release.length = 0.4;
  s.release.width = 0.3;
  s.release.height = 0.302;
  EXPECT_DOUBLE_EQ(shape_volume(s), 0.4 * 0.3 * 0.302);
  EXPECT_EQ(shape_depth(s, 0.51, 0.1), 0.302);
  EXPECT_EQ(shape_depth(s, 0.49, 0.1), 0);
  s.release.kind = ReleaseSpec::Kind::uniform;
  s.obstacles.push_back({"post", 1, 0, 0.1, 0.2, 0.5});
  EXPECT_DOUBLE_EQ(shape_volume(s), (2 - 0.02) * 0.302);
  EXPECT_EQ(shape_depth(s, 1.05, 0.05), 0) << "nothing stands in an obstacle";
  EXPECT_EQ(shape_depth(s, 0.9, 0.05), 0.302);
}

TEST(ReleaseShape, LeavesTheTrianglesBaseFree) {
  Scene s = blank();
  s.release.kind = ReleaseSpec::Kind::uniform;
  s.release.height = 0.02;
  s.obstacles.push_back({"wedge", 1, 0.1, 0.3, 0.4, 0.5, ObstacleSpec::Shape::tetrahedron});
  EXPECT_NEAR(shape_volume(s), (2 * 1 - 0.5 * 0.3 * 0.4) * 0.02, 1e-15);
  EXPECT_EQ(shape_depth(s, 1.15, 0.199), 0);
  EXPECT_EQ(shape_depth(s, 1.15, 0.001), 0);
  EXPECT_EQ(shape_depth(s, 1.15, 0.201), 0.02);
  EXPECT_EQ(shape_depth(s, 1.15, -0.001), 0.02);
  EXPECT_EQ(shape_depth(s, 0.99, 0.1), 0.02);
}

}  // namespace
}  // namespace couloir
