// Grains on the rough base touch it across the periodic sides as they do within: the engine must not lose what lies beyond a
// side.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "coupling/calibration/slab.hpp"
#include "coupling/engine/worker_engine.hpp"

using namespace couloir;
using Point = Eigen::Vector3d;

namespace {

double to_segment(const Point& p, const Point& a, const Point& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

// [m] from a point to a triangle: to its inside where the point lies above or below that, else to its edges.
double to_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point n = (b - a).cross(c - a);
  const bool above = (b - a).cross(p - a).dot(n) >= 0 && (c - b).cross(p - b).dot(n) >= 0 && (a - c).cross(p - c).dot(n) >= 0;
  if (above) return std::abs((p - a).dot(n)) / n.norm();
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

}  // namespace

TEST(RoughBase, CarriesGrainsAcrossItsPeriodicSides) {
  PackingSpec spec;
  const double d = spec.diameter = 0.004;
  spec.density = 1120;
  spec.length = 12 * d;
  spec.width = 6 * d;
  std::string folder = (std::filesystem::temp_directory_path() / "couloir-base-XXXXXX").string();
  EngineSetup setup = grain_setup(spec, mkdtemp(folder.data()));
  setup.gravity = {0, 0, -slab_gravity};
  setup.hi = {spec.length, spec.width, 10 * d};
  setup.rolling_friction = 0.5;
  setup.surfaces = {{"base", rough_base(spec.length, spec.width, d), 1, 0.5}};
  AdvanceRequest request;
  request.steps = 15000;
  for (int i = 0; i < 11; ++i) {
    for (int j = 0; j < 5; ++j) {
      NewGrain n;
      n.id = 1 + 5 * i + j;
      n.radius = 0.5 * d;
      n.position = {(i + 0.02) * spec.length / 11, (j + 0.02) * spec.width / 5, 1.6 * d};
      request.insert.push_back(n);
    }
  }
  WorkerEngine engine(worker_path("liggghts"));
  engine.start(setup);
  const Grains grains = engine.advance(request).grains;
  engine.stop();
  std::filesystem::remove_all(folder);

  int beside = 0;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const double x = grains.x[k] - spec.length * std::floor(grains.x[k] / spec.length);
    const double y = grains.y[k] - spec.width * std::floor(grains.y[k] / spec.width);
    beside += std::min({x, spec.length - x, y, spec.width - y}) < 0.5 * d;
    double nearest = 1;
    for (const Triangle& t : setup.surfaces[0].triangles) {
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
          const auto moved = [&](const Vec& v) { return Point(v[0] + i * spec.length, v[1] + j * spec.width, v[2]); };
          nearest = std::min(nearest, to_triangle({x, y, grains.z[k]}, moved(t.a), moved(t.b), moved(t.c)));
        }
      }
    }
    EXPECT_NEAR(nearest, 0.5 * d, 0.003 * d) << "grain " << grains.id[k] << " at " << x / d << " d, " << y / d << " d";
  }
  EXPECT_EQ(grains.size(), 55u);
  EXPECT_GT(beside, 8);
}
