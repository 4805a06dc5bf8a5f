#include "continuum/flow/earth_pressure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "continuum/scheme/mobilisation.hpp"
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

// A row whose velocity falls (or rises) along x by `rate` per second and metre, weightless so that only strain acts.
Solver strained_row(double rate, double duration) {
  SolverSettings s = basin(40, 3, 0.05);
  s.gravity = 1e-9;
  s.closure = quartz();
  s.closure.tan_delta = 0;
  Solver solver(s, ReferenceSurface::flat(2), {});
  solver.set([=](double x, double) { return FlowState{0.1, 0.1 * rate * (x - 1), 0}; });
  while (solver.time() < 0.999 * duration) solver.step(duration / 200);
  return solver;
}

TEST(EarthPressure, FollowsTheStrain) {
  const EarthPressure k = quartz().earth_pressure;
  EXPECT_EQ(strained_row(-0.5, 0.0).earth_pressure(20, 1)[0], k.x_active);
  // Compressed at 0.5 1/s, faster while it goes on: ln(1 - 0.5 t).
  EXPECT_NEAR(strained_row(-0.5, 0.2).earth_pressure(20, 1)[0], k.kx_mobilised(-std::log(0.9) / passive_strain), 1e-3);
  EXPECT_EQ(strained_row(-0.5, 0.8).earth_pressure(20, 1)[0], k.x_passive);
  EXPECT_EQ(strained_row(+0.5, 0.8).earth_pressure(20, 1)[0], k.x_active);
}

TEST(EarthPressure, TravelsWithTheFlow) {
  SolverSettings s = basin(120, 3, 0.05);
  s.sides = sides(Side::Kind::outflow, Side::Kind::wall);
  s.gravity = 1e-9;
  s.closure = quartz();
  s.closure.tan_delta = 0;
  const EarthPressure k = s.closure.earth_pressure;
  Solver solver(s, ReferenceSurface::flat(6), {});
  // Fast behind slow: what has been compressed between them goes on.
  solver.set([](double x, double) { return FlowState{x < 4 ? 0.05 : 0.0, x < 0.5 ? 0.1 : 0.05, 0}; });
  const auto centre = [&] {
    double sum = 0, moment = 0;
    for (int i = 0; i < 120; ++i) {
      const double passive = solver.at(i, 1).h > 0 ? solver.earth_pressure(i, 1)[0] - k.x_active : 0.0;
      sum += passive, moment += passive * s.grid.x(i);
    }
    return moment / sum;
  };
  solver.advance_to(0.5);
  const double before = centre();
  solver.advance_to(1.0);
  EXPECT_GT(centre() - before, 0.5);
  EXPECT_LT(centre() - before, 1.0);
}

TEST(EarthPressure, StaysAsItIsInADeposit) {
  SolverSettings s = basin(60, 3, 0.02);
  s.closure = quartz();
  const EarthPressure k = s.closure.earth_pressure;
  Solver solver(s, ReferenceSurface::incline(degrees(25), 1.2), {});
  solver.set([](double x, double) { return FlowState{x < 0.4 ? 0.05 : 0.0, x < 0.4 ? 0.05 : 0.0, 0}; });
  solver.advance_to(4);
  ASSERT_EQ(solver.max_speed(), 0);
  std::vector<std::array<double, 2>> rest;
  bool between = false;
  for (int i = 0; i < 60; ++i) {
    rest.push_back(solver.earth_pressure(i, 1));
    between = between || (rest[i][0] > k.x_active && rest[i][0] < k.x_passive);
  }
  EXPECT_TRUE(between);
  solver.advance_to(6);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(solver.earth_pressure(i, 1), rest[i]) << i;
}

// Waves of the earth pressure are damped: without friction nothing else would even out ripples of a few cells.
TEST(EarthPressure, RaisesNoRipples) {
  struct Basin {
    double slope, speed, until;
  };
  for (const Basin& basin : {Basin{0, 0.3, 0.8}, Basin{5, 0, 0.3}}) {
    double coarse = 0;
    for (const int n : {200, 400, 800}) {
      SolverSettings s;
      s.grid = {n, 1, 1.0 / n, 1.0 / n, 0, 0};
      s.sides = sides(Side::Kind::wall, Side::Kind::wall);
      s.closure = {EarthPressure::active_passive(degrees(37), 0), 0, true};
      Solver solver(s, ReferenceSurface::incline(degrees(basin.slope), 1), {});
      solver.set([&](double, double) { return FlowState{0.05, 0.05 * basin.speed, 0}; });
      solver.advance_to(basin.until);
      double variation = 0;
      for (int i = 1; i < n; ++i) variation += std::abs(solver.at(i, 0).h - solver.at(i - 1, 0).h);
      if (n == 200) coarse = variation;
      EXPECT_LT(variation, 1.2 * coarse) << n << " cells, slope " << basin.slope;
    }
  }
}

}  // namespace
}  // namespace couloir::test
