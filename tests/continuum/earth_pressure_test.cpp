#include "continuum/flow/earth_pressure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "scenes.hpp"

namespace couloir::test {
namespace {

// references.md section 1.
TEST(EarthPressure, HasThePublishedValues) {
  const auto quartz = EarthPressure::active_passive(degrees(40), degrees(28));
  EXPECT_NEAR(quartz.x_active, 0.71341, 5e-6);
  EXPECT_NEAR(quartz.x_passive, 4.10294, 5e-6);
  const auto vestolen = EarthPressure::active_passive(degrees(37), degrees(24));
  EXPECT_NEAR(vestolen.x_active, 0.61319, 5e-6);
  EXPECT_NEAR(vestolen.x_passive, 3.65818, 5e-6);
  const auto yellow_sand = EarthPressure::active_passive(degrees(33), degrees(27));
  EXPECT_NEAR(yellow_sand.x_active, 0.88329, 5e-6);
  EXPECT_NEAR(yellow_sand.x_passive, 2.80363, 5e-6);
  const auto equal = EarthPressure::active_passive(degrees(35), degrees(35));
  EXPECT_NEAR(equal.x_active, 1.98058, 5e-6);
  EXPECT_NEAR(equal.x_passive, 1.98058, 5e-6);
}

// (2.84) gives the principal stresses of [[K_x, tan delta], [tan delta, 1]]: trace and determinant.
TEST(EarthPressure, AcrossTheSlopeIsAPrincipalStress) {
  const double t = std::tan(degrees(28));
  const auto k = EarthPressure::active_passive(degrees(40), degrees(28));
  EXPECT_NEAR(k.y_active_active + k.y_passive_active, k.x_active + 1, 1e-12);
  EXPECT_NEAR(k.y_active_active * k.y_passive_active, k.x_active - t * t, 1e-12);
  EXPECT_NEAR(k.y_active_passive + k.y_passive_passive, k.x_passive + 1, 1e-12);
  EXPECT_NEAR(k.y_active_passive * k.y_passive_passive, k.x_passive - t * t, 1e-12);
  EXPECT_LT(k.y_active_active, k.y_passive_active);
}

TEST(EarthPressure, FollowsTheSignsOfStretching) {
  const auto k = EarthPressure::active_passive(degrees(40), degrees(28));
  EXPECT_EQ(k.kx(0), k.x_active);
  EXPECT_EQ(k.kx(-1), k.x_passive);
  EXPECT_EQ(k.ky(1, 1), k.y_active_active);
  EXPECT_EQ(k.ky(1, -1), k.y_passive_active);
  EXPECT_EQ(k.ky(-1, 1), k.y_active_passive);
  EXPECT_EQ(k.ky(-1, -1), k.y_passive_passive);
}

TEST(EarthPressure, MobilisesFromActiveToPassive) {
  const auto k = EarthPressure::active_passive(degrees(40), degrees(28));
  EXPECT_EQ(k.kx_mobilised(0), k.x_active);
  EXPECT_EQ(k.kx_mobilised(1), k.x_passive);
  EXPECT_DOUBLE_EQ(k.kx_mobilised(0.5), 0.5 * (k.x_active + k.x_passive));
  EXPECT_EQ(k.ky_mobilised(0, 0), k.y_active_active);
  EXPECT_EQ(k.ky_mobilised(0, 1), k.y_passive_active);
  EXPECT_EQ(k.ky_mobilised(1, 0), k.y_active_passive);
  EXPECT_EQ(k.ky_mobilised(1, 1), k.y_passive_passive);
}

TEST(EarthPressure, RefusesAnglesWithoutAStress) {
  EXPECT_THROW(EarthPressure::active_passive(degrees(28), degrees(40)), std::invalid_argument);
  EXPECT_THROW(EarthPressure::active_passive(degrees(90), degrees(40)), std::invalid_argument);
}

TEST(EarthPressure, OfACellComesFromItsNeighboursVelocities) {
  SolverSettings s = basin(10, 5, 0.1);
  s.gravity = 0.1;  // slow waves: this compression mobilises all of the passive state
  s.closure = quartz();
  const EarthPressure k = s.closure.earth_pressure;
  Solver solver(s, ReferenceSurface::flat(1), {});
  solver.set([](double x, double y) { return FlowState{0.1, 0.2 * (x < 0.5 ? x : 1 - x), 0.2 * y + 0.1}; });
  EXPECT_EQ(solver.earth_pressure(2, 2), (std::array<double, 2>{k.x_active, k.y_active_active}));
  EXPECT_EQ(solver.earth_pressure(7, 2), (std::array<double, 2>{k.x_passive, k.y_active_passive}));
}

}  // namespace
}  // namespace couloir::test
