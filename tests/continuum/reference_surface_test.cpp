#include "continuum/terrain/reference_surface.hpp"

#include <gtest/gtest.h>

#include "scenes.hpp"

namespace couloir::test {
namespace {

const ReferenceSurface chute() {
  return ReferenceSurface::chute(degrees(40), 0.65, 0.1465, 0.8);
}

TEST(ReferenceSurface, ComesBackFromSpace) {
  const ReferenceSurface s = chute();
  for (double x = -0.1; x < 1.7; x += 0.013) {
    for (double n : {-0.05, 0.0, 0.1, 0.19}) {
      const SurfacePoint p = s.to_surface(s.to_space({x, 0.3, n}));
      EXPECT_NEAR(p.x, x, 1e-13);
      EXPECT_EQ(p.y, 0.3);
      EXPECT_NEAR(p.n, n, 1e-13);
    }
  }
}

TEST(ReferenceSurface, AgreesWithSpaceOnTheIncline) {
  const Eigen::Vector3d p = chute().to_space({0.4, -0.1, 0.02});
  EXPECT_EQ(p, Eigen::Vector3d(0.4, -0.1, 0.02));
}

// The laboratory chute's transition: 146.5 mm of arc through 40 deg is a radius of 209.8 mm (references.md section 1).
TEST(ReferenceSurface, CurvatureIsOneOverTheRadius) {
  const ReferenceSurface s = chute();
  EXPECT_EQ(s.curvature(0.3), 0);
  EXPECT_NEAR(1 / s.curvature(0.7), 0.2098, 5e-5);
  EXPECT_EQ(s.curvature(1.0), 0);
  EXPECT_NEAR(s.curvature(0.7), -(s.angle(0.7001) - s.angle(0.6999)) / 0.0002, 1e-9);
}

TEST(ReferenceSurface, TangentFollowsTheCurve) {
  const ReferenceSurface s = chute();
  for (double x : {0.2, 0.66, 0.7, 0.75, 1.2}) {
    const double d = 1e-6;
    const Eigen::Vector3d t = (s.to_space({x + d, 0, 0}) - s.to_space({x - d, 0, 0})) / (2 * d);
    EXPECT_NEAR((t - s.tangent(x)).norm(), 0, 1e-9) << x;
    EXPECT_NEAR(s.tangent(x).dot(s.normal(x)), 0, 1e-15);
    EXPECT_NEAR(s.gravity_direction().dot(s.tangent(x)), std::sin(s.angle(x)), 1e-14);
  }
}

TEST(ReferenceSurface, RunOutIsLevelInTheLevelFrame) {
  const ReferenceSurface s = chute();
  EXPECT_EQ(s.angle(1.0), 0);
  const double z1 = s.to_level(s.to_space({1.0, 0, 0})).z(), z2 = s.to_level(s.to_space({1.5, 0, 0})).z();
  EXPECT_NEAR(z1, z2, 1e-14);
  EXPECT_LT(z1, 0);
  EXPECT_NEAR(s.to_level(s.gravity_direction()).z(), -1, 1e-15);
}

TEST(ReferenceSurface, FlatAndInclineAreStraight) {
  const ReferenceSurface flat = ReferenceSurface::flat(2), incline = ReferenceSurface::incline(degrees(30), 2);
  EXPECT_EQ(flat.angle(1), 0);
  EXPECT_EQ(flat.length(), 2);
  EXPECT_FALSE(flat.curved());
  EXPECT_EQ(incline.angle(5), degrees(30));
  EXPECT_EQ(incline.to_space({3, 1, 0.5}), Eigen::Vector3d(3, 1, 0.5));
  EXPECT_EQ(incline.to_surface({3, 1, 0.5}).x, 3);
}

// Steep, gentler, over a brink, into a bowl and uphill.
const ReferenceSurface profile() {
  return ReferenceSurface::profile({{0, degrees(35)},
                                    {0.4, degrees(35)},
                                    {0.6, degrees(10)},
                                    {0.9, degrees(10)},
                                    {1.1, degrees(40)},
                                    {1.5, degrees(0)},
                                    {1.8, degrees(-20)},
                                    {2.0, degrees(-20)}});
}

TEST(ReferenceSurface, ProfileComesBackFromSpace) {
  const ReferenceSurface s = profile();
  EXPECT_EQ(s.length(), 2.0);
  for (double x = -0.1; x < 2.2; x += 0.0137)
    for (double n : {-0.05, 0.0, 0.1, 0.19}) {
      const SurfacePoint p = s.to_surface(s.to_space({x, 0.3, n}));
      EXPECT_NEAR(p.x, x, 1e-13) << n;
      EXPECT_NEAR(p.n, n, 1e-13) << x;
    }
}

TEST(ReferenceSurface, ProfileHasItsAnglesAndArcs) {
  const ReferenceSurface s = profile();
  for (const auto& [x, angle] :
       {std::pair{0.0, 35.0}, {0.5, 22.5}, {0.7, 10.0}, {1.0, 25.0}, {1.3, 20.0}, {1.65, -10.0}, {1.9, -20.0}})
    EXPECT_NEAR(s.angle(x), degrees(angle), 1e-15) << x;
  ASSERT_EQ(s.arcs().size(), 4u);
  EXPECT_NEAR(s.arcs()[0].curvature, degrees(25) / 0.2, 1e-12);
  EXPECT_NEAR(s.arcs()[1].curvature, -degrees(30) / 0.2, 1e-12) << "a brink";
  for (double x : {0.2, 0.5, 0.8, 1.0, 1.2, 1.6, 1.9}) {
    const double d = 1e-6;
    const Eigen::Vector3d t = (s.to_space({x + d, 0, 0}) - s.to_space({x - d, 0, 0})) / (2 * d);
    EXPECT_NEAR((t - s.tangent(x)).norm(), 0, 1e-9) << x;
    EXPECT_NEAR(s.gravity_direction().dot(s.tangent(x)), std::sin(s.angle(x)), 1e-14);
    EXPECT_NEAR(s.curvature(x), -(s.angle(x + d) - s.angle(x - d)) / (2 * d), 1e-8) << x;
  }
  EXPECT_NEAR((s.to_space({2.0, 0, 0}) - s.to_space({1.8, 0, 0})).norm(), 0.2, 1e-14) << "straight at its end";
}

TEST(ReferenceSurface, AChuteIsAProfile) {
  const ReferenceSurface a = chute();
  const ReferenceSurface b =
      ReferenceSurface::profile({{0, degrees(40)}, {0.65, degrees(40)}, {0.65 + 0.1465, 0}, {0.65 + 0.1465 + 0.8, 0}});
  for (double x = -0.1; x < 1.7; x += 0.013) {
    EXPECT_NEAR((a.to_space({x, 0, 0.02}) - b.to_space({x, 0, 0.02})).norm(), 0, 1e-15);
    EXPECT_NEAR(a.curvature(x), b.curvature(x), 1e-14);
  }
}

TEST(ReferenceSurface, RefusesWhatIsNoProfile) {
  const auto profile = [](std::vector<ProfilePoint> p) { return ReferenceSurface::profile(p); };
  EXPECT_THROW(profile({{0, 0.5}}), std::invalid_argument);
  EXPECT_THROW(profile({{0.1, 0.5}, {1, 0.5}}), std::invalid_argument);
  EXPECT_THROW(profile({{0, 0.5}, {1, 0.5}, {1, 0.2}}), std::invalid_argument);
  EXPECT_THROW(profile({{0, 1.6}, {1, 0.5}}), std::invalid_argument);
  EXPECT_THROW(profile({{0, 1.0}, {1, -0.7}}), std::invalid_argument) << "turns by more than a right angle";
}

TEST(ReferenceSurface, RefusesWhatIsNoSurface) {
  EXPECT_THROW(ReferenceSurface::incline(degrees(90), 1), std::invalid_argument);
  EXPECT_THROW(ReferenceSurface::incline(degrees(30), 0), std::invalid_argument);
  EXPECT_THROW(ReferenceSurface::chute(degrees(30), 1, -1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace couloir::test
