#include "coupling/plan/mass_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace couloir {
namespace {

constexpr double g = 9.81, deg = std::numbers::pi / 180;

TEST(MassPoint, IsExactOnAnIncline) {
  const double a = 35 * deg, mu = 0.4, u0 = 1;
  for (const int steps : {1, 7, 400}) {
    const MassPoint end = slide(ReferenceSurface::incline(a, 3), g, mu, {0.5, 0, u0}, 3, steps).back();
    const double acceleration = g * (std::sin(a) - mu * std::cos(a));
    EXPECT_EQ(end.x, 3);
    EXPECT_NEAR(end.velocity * end.velocity, u0 * u0 + 2 * acceleration * 2.5, 1e-12);
    EXPECT_NEAR(u0 * end.time + acceleration * end.time * end.time / 2, 2.5, 1e-12);
    EXPECT_NEAR(energy_head(end, g), end.velocity * end.velocity / 19.62, 1e-15);
  }
}

TEST(MassPoint, StopsWhereFrictionHasTakenItsSpeed) {
  const double mu = 0.5, u0 = 2;
  const auto line = slide(ReferenceSurface::incline(0, 3), g, mu, {0.1, 0, u0}, 3, 11);
  EXPECT_NEAR(line.back().x, 0.1 + u0 * u0 / (2 * mu * g), 1e-12);
  EXPECT_NEAR(line.back().time, u0 / (mu * g), 1e-12);
  EXPECT_EQ(line.back().velocity, 0);
  EXPECT_EQ(slide(ReferenceSurface::incline(0.1, 3), g, mu, {1, 0, 0}, 3, 11).size(), 1u) << "friction holds it";
}

// The energy line falls by mu over each metre of horizontal distance, whatever the bed: Heim's run-out.
TEST(MassPoint, StopsWhereTheEnergyLineMeetsTheBed) {
  const double a = 40 * deg, mu = std::tan(30 * deg), slope = 1, arc = 0.4, runout = 4;
  const ReferenceSurface chute = ReferenceSurface::chute(a, slope, arc, runout);
  const auto place = [&](double x) { return chute.to_level(chute.to_space({x, 0, 0})); };
  const auto line = slide(chute, g, mu, {0.2, 0, 0}, slope + arc + runout, 4000);
  ASSERT_EQ(line.back().velocity, 0);
  ASSERT_LT(line.back().x, slope + arc + runout);
  const Eigen::Vector3d from = place(0.2), to = place(line.back().x);
  EXPECT_NEAR(from.z() - to.z(), mu * std::abs(to.x() - from.x()), 1e-5);
  const MassPoint middle = line[line.size() / 2];
  EXPECT_NEAR(energy_head(middle, g), from.z() - place(middle.x).z() - mu * std::abs(place(middle.x).x() - from.x()), 1e-5);
}

}  // namespace
}  // namespace couloir
