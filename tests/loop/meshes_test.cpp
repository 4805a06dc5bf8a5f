#include "coupling/loop/meshes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace couloir {
namespace {

double area(const std::vector<Triangle>& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh) {
    const Eigen::Vector3d a(t.a[0], t.a[1], t.a[2]), b(t.b[0], t.b[1], t.b[2]), c(t.c[0], t.c[1], t.c[2]);
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

TEST(Meshes, BedCoversItsPatch) {
  EXPECT_NEAR(area(bed_mesh(ReferenceSurface::incline(0.6, 1), {0.1, 0.5, -0.1, 0.2}, 0.03)), 0.4 * 0.3, 1e-12);
}

TEST(Meshes, BedFollowsTheArc) {
  const auto surface = ReferenceSurface::chute(0.7, 0.9, 0.15, 0.8);
  EXPECT_NEAR(area(bed_mesh(surface, {0.9, 1.05, 0, 1}, 0.005)), 0.15, 1e-4);
}

TEST(Meshes, CuboidHasFiveFacesAndStandsOnTheBed) {
  ObstacleSpec o{"wall", 0.4, 0, 0.01, 0.06, 0.04};
  const auto surface = ReferenceSurface::incline(0.6, 1);
  const auto mesh = cuboid_mesh(surface, o, 0.02);
  EXPECT_NEAR(area(mesh), 2 * 0.06 * 0.04 + 2 * 0.01 * 0.04 + 0.01 * 0.06, 1e-12);
  double low = 1, high = 0, first = 1, last = 0;
  for (const Triangle& t : mesh)
    for (const Vec* p : {&t.a, &t.b, &t.c}) {
      const SurfacePoint s = surface.to_surface({(*p)[0], (*p)[1], (*p)[2]});
      low = std::min(low, s.n), high = std::max(high, s.n), first = std::min(first, s.x), last = std::max(last, s.x);
    }
  EXPECT_NEAR(low, 0, 1e-12);
  EXPECT_NEAR(high, 0.04, 1e-12);
  EXPECT_NEAR(first, 0.40, 1e-12);
  EXPECT_NEAR(last, 0.41, 1e-12);
}

}  // namespace
}  // namespace couloir
