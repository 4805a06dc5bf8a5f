#include "coupling/loop/meshes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
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
  const double size = 0.04;
  for (const Triangle& t : bed_mesh(surface, {0.8, 1.2, 0, 0.1}, size)) {
    const SurfacePoint middle = surface.to_surface({(t.a[0] + t.c[0]) / 2, 0, (t.a[2] + t.c[2]) / 2});
    EXPECT_LE(std::abs(middle.n), 1.01e-3 * size)
        << "grains that are laid on the arc would be pressed into it at x = " << middle.x;
  }
}

// Radius 0.21 m, the wall 0.4 m high: lines along the normals would cross.
TEST(Meshes, ASideWallAboveATightArcIsOneSheet) {
  const auto surface = ReferenceSurface::chute(0.7, 0.3, 0.15, 0.3);
  const auto mesh = side_mesh(surface, 0.1, 0.7, 0.05, 0.4, 0.03);
  double low = 1, high = -1, first = 1, last = -1, sum = area(mesh);
  for (const Triangle& t : mesh)
    for (const Vec* p : {&t.a, &t.b, &t.c}) {
      EXPECT_EQ((*p)[1], 0.05);
      first = std::min(first, (*p)[0]), last = std::max(last, (*p)[0]), low = std::min(low, (*p)[2]),
      high = std::max(high, (*p)[2]);
    }
  EXPECT_NEAR(sum, (last - first) * (high - low), 1e-12) << "no part of it twice";
  for (const double x : {0.1, 0.35, 0.7})
    for (const double n : {0.0, 0.4}) {
      const Eigen::Vector3d p = surface.to_space({x, 0.05, n});
      EXPECT_TRUE(p.x() >= first - 1e-12 && p.x() <= last + 1e-12 && p.z() >= low - 1e-12 && p.z() <= high + 1e-12);
    }
}

TEST(Meshes, CuboidHasFiveFacesAndStandsOnTheBed) {
  ObstacleSpec o{"wall", 0.4, 0, 0.01, 0.06, 0.04};
  const auto surface = ReferenceSurface::incline(0.6, 1);
  const auto mesh = cuboid_mesh(surface, o, 0.02).rest;
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

// The seed's wedge: faces by (4.2), (4.3), closed but for its base, all normals outward, edges no longer than asked.
TEST(Meshes, TetrahedronHasThreeFacesThatLookOut) {
  ObstacleSpec o{"wedge", 0.65, 0.02, std::sqrt(3.0) / 2 * 0.16, 0.16, 0.08, ObstacleSpec::Shape::tetrahedron};
  const auto surface = ReferenceSurface::incline(0.7, 1);
  for (const double size : {1.0, 0.03}) {
    const auto mesh = obstacle_mesh(surface, o, size).rest;
    EXPECT_EQ(mesh.size() == 3, size == 1.0);
    const double xc = 0.65 + 0.16 / std::sqrt(3.0), apothem = o.length - 0.16 / std::sqrt(3.0);
    EXPECT_NEAR(area(mesh), 3 * 0.5 * 0.16 * std::hypot(apothem, 0.08), 1e-12);
    double volume = 0, high = 0;
    std::array<double, 3> sum{};
    for (const Triangle& t : mesh) {
      const Eigen::Vector3d a(t.a[0], t.a[1], t.a[2]), b(t.b[0], t.b[1], t.b[2]), c(t.c[0], t.c[1], t.c[2]);
      for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}}) EXPECT_LE((p - q).norm(), size * (1 + 1e-9));
      const Eigen::Vector3d normal = 0.5 * (b - a).cross(c - a);
      const Eigen::Vector3d inside(xc, 0.02, 0.01);
      EXPECT_GT(normal.dot((a + b + c) / 3 - inside), 0);
      EXPECT_GT(normal.z(), 0);
      volume += normal.dot((a + b + c) / 3) / 3;
      for (int k = 0; k < 3; ++k) sum[k] += normal[k];
      for (const auto& p : {a, b, c}) {
        high = std::max(high, p.z());
        if (p.z() > 0.08 - 1e-9) {
          EXPECT_NEAR((p - Eigen::Vector3d(xc, 0.02, 0.08)).norm(), 0, 1e-12);
        }
      }
    }
    const double base = 0.5 * 0.16 * o.length;
    EXPECT_NEAR(volume, base * 0.08 / 3, 1e-12);  // the base lies in z = 0 and adds nothing
    EXPECT_NEAR(sum[0], 0, 1e-12);
    EXPECT_NEAR(sum[1], 0, 1e-12);
    EXPECT_NEAR(sum[2], base, 1e-12);
    EXPECT_NEAR(high, 0.08, 1e-12);
  }
}

}  // namespace
}  // namespace couloir
