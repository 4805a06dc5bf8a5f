// The face with gauges: covered once, without nodes in the middle of edges, gauges of the right area.

#include "coupling/loop/front_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "coupling/loop/meshes.hpp"
#include "coupling/scene/stress_gauge.hpp"

namespace couloir {
namespace {

const ObstacleSpec wall{"wall", 0.4, 0, 0.01, 0.16, 0.08};

StressGaugeSpec rectangle(double across, double up, double width, double height) {
  return {"r", 0, across, up, width, height, 0};
}

StressGaugeSpec circle(double across, double up, double radius) {
  return {"c", 0, across, up, 0, 0, radius};
}

double twice_area(const FaceTriangle& t) {  // of the face: shares
  return (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
}

double area(const std::vector<FaceTriangle>& mesh, const ObstacleSpec& o) {
  double sum = 0;
  for (const FaceTriangle& t : mesh) sum += 0.5 * twice_area(t) * o.width * o.height;
  return sum;
}

bool holds(const FaceTriangle& t, const FacePoint& p) {
  for (int k : {0, 1, 2})
    if (twice_area({t[k], t[(k + 1) % 3], p}) < 0) return false;
  return true;
}

double least_angle(const FaceTriangle& t, const ObstacleSpec& o) {
  double least = std::numbers::pi;
  for (int k : {0, 1, 2}) {
    const auto leg = [&](int to) { return std::array{(t[to][0] - t[k][0]) * o.width, (t[to][1] - t[k][1]) * o.height}; };
    const auto a = leg((k + 1) % 3), b = leg((k + 2) % 3);
    least = std::min(least, std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]));
  }
  return least;
}

// Each edge of the rest is another triangle's turned round, or lies on a gauge or on the face's rim.
void expect_conforming(const FrontMesh& mesh, const ObstacleSpec& o, const std::vector<StressGaugeSpec>& gauges) {
  std::map<std::pair<FacePoint, FacePoint>, int> edges;
  for (const FaceTriangle& t : mesh.rest)
    for (int k : {0, 1, 2}) ++edges[{t[k], t[(k + 1) % 3]}];
  double rim = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    if (edges.contains({edge.second, edge.first})) continue;
    rim += std::hypot((edge.second[0] - edge.first[0]) * o.width, (edge.second[1] - edge.first[1]) * o.height);
  }
  double expected = 2 * (o.width + o.height);
  for (const StressGaugeSpec& g : gauges) {
    const GaugeBox b = gauge_box(g);
    expected += g.radius > 0 ? 2 * gauge_sides * gauge_flat(g) : 2 * (b.right - b.left + b.high - b.low);
    const bool at_foot = b.low < 1e-9;  // where both rims are one, and inside of nothing
    if (at_foot) expected -= 2 * (g.radius > 0 ? 2 * gauge_flat(g) : b.right - b.left);
  }
  EXPECT_NEAR(rim, expected, 1e-12);
}

void expect_covered_once(const FrontMesh& mesh, const std::vector<StressGaugeSpec>& gauges, const ObstacleSpec& o) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int n = 0; n < 4000; ++n) {
    const FacePoint p{share(random), share(random)};
    int found = 0, of = -1;
    for (const FaceTriangle& t : mesh.rest) found += holds(t, p);
    for (std::size_t k = 0; k < mesh.gauges.size(); ++k)
      for (const FaceTriangle& t : mesh.gauges[k])
        if (holds(t, p)) ++found, of = int(k);
    ASSERT_EQ(found, 1) << p[0] << " " << p[1];
    for (std::size_t k = 0; k < gauges.size(); ++k) {
      const double x = (p[0] - 0.5) * o.width - gauges[k].across, y = p[1] * o.height - gauges[k].up, r = gauges[k].radius;
      const bool round = r > 0;
      if (round && std::hypot(x, y) > r && std::hypot(x, y) < 1.02 * r) continue;  // between circle and polygon
      const bool inside = round ? std::hypot(x, y) < r : std::abs(x) < gauges[k].width / 2 && std::abs(y) < gauges[k].height / 2;
      ASSERT_EQ(inside, of == int(k)) << p[0] << " " << p[1];
    }
  }
}

TEST(FrontMesh, CoversTheFaceOnceAroundItsGauges) {
  const std::vector<std::vector<StressGaugeSpec>> cases{
      {},
      {rectangle(0, 0.04, 0.04, 0.03)},
      {circle(0, 0.04, 0.02)},
      {circle(0.01, 0.02, 0.02)},                               // on the foot
      {circle(-0.04, 0.03, 0.02), circle(0.03, 0.043, 0.025)},  // whose lines cross each other's squares
      {circle(-0.05, 0.03, 0.02), rectangle(0.02, 0.02, 0.03, 0.02), rectangle(0.035, 0.06, 0.06, 0.03)},
      {rectangle(-0.02, 0.02, 0.04, 0.04), rectangle(0.02, 0.02, 0.04, 0.04)},  // side by side, on the foot
  };
  for (const auto& gauges : cases) {
    for (const double size : {0.2, 0.025, 0.007}) {
      const FrontMesh mesh = front_mesh(wall, gauges, size);
      double sum = area(mesh.rest, wall);
      ASSERT_EQ(mesh.gauges.size(), gauges.size());
      for (std::size_t k = 0; k < gauges.size(); ++k) {
        EXPECT_NEAR(area(mesh.gauges[k], wall), gauge_area(gauges[k]), 1e-14);
        sum += area(mesh.gauges[k], wall);
      }
      EXPECT_NEAR(sum, wall.width * wall.height, 1e-14);
      SCOPED_TRACE(std::to_string(&gauges - cases.data()) + " at " + std::to_string(size));
      expect_covered_once(mesh, gauges, wall);
      const double smallest_angle = 0.5 * std::numbers::pi / 180;  // below which LIGGGHTS leaves triangles out
      for (const auto* part : {&mesh.rest, mesh.gauges.empty() ? &mesh.rest : &mesh.gauges[0]})
        for (const FaceTriangle& t : *part) EXPECT_GT(least_angle(t, wall), smallest_angle);
      const bool touch = gauges.size() == 2 && gauges[0].radius == 0;
      if (!touch) expect_conforming(mesh, wall, gauges);
    }
  }
}

TEST(FrontMesh, AGaugeMayBeTheWholeFace) {
  const FrontMesh mesh = front_mesh(wall, {rectangle(0, 0.04, 0.16, 0.08)}, 0.025);
  EXPECT_TRUE(mesh.rest.empty());
  EXPECT_NEAR(area(mesh.gauges[0], wall), 0.16 * 0.08, 1e-14);
}

// A gauge changes no other face, and no face's place.
TEST(FrontMesh, ACuboidKeepsItsSurface) {
  const auto surface = ReferenceSurface::incline(0.6, 1);
  const auto sum = [](const std::vector<Triangle>& mesh) {
    double all = 0;
    for (const Triangle& t : mesh) {
      const Eigen::Vector3d a(t.a.data()), b(t.b.data()), c(t.c.data());
      all += 0.5 * (b - a).cross(c - a).norm();
    }
    return all;
  };
  const double whole = sum(cuboid_mesh(surface, wall, 0.025).rest), front = 0.16 * 0.08;
  const ObstacleMesh parts = cuboid_mesh(surface, wall, 0.025, {circle(0, 0.04, 0.02)});
  EXPECT_NEAR(sum(parts.gauges.at(0)), 16 * std::tan(std::numbers::pi / 16) * 4e-4, 1e-14);
  EXPECT_NEAR(sum(parts.rest) + sum(parts.gauges[0]), whole, 1e-14);
  EXPECT_NEAR(whole, 2 * front + 2 * 0.01 * 0.08 + 0.01 * 0.16, 1e-14);
  for (const Triangle& t : parts.gauges[0])
    for (const Vec* p : {&t.a, &t.b, &t.c}) {
      const SurfacePoint s = surface.to_surface({(*p)[0], (*p)[1], (*p)[2]});
      EXPECT_NEAR(s.x, 0.4, 1e-12);
      EXPECT_LT(std::hypot(s.y, s.n - 0.04), 0.02 * 1.02);
      EXPECT_GE(s.n, 0.02 - 1e-12);
    }
}

}  // namespace
}  // namespace couloir
