#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.hpp"

namespace couloir::test {
namespace {

double smooth_bed(double x, double y) {
  return 0.3 * std::exp(-8 * ((x - 1) * (x - 1) + y * y));
}

std::vector<double> sample(const Grid& g, double (*f)(double, double)) {
  std::vector<double> z;
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) z.push_back(f(g.x(i), g.y(j)));
  }
  return z;
}

double departure(const Solver& s, const Bits& start) {
  const Bits now = bits(s);
  double most = 0;
  for (std::size_t k = 0; k < now.h.size(); ++k) {
    most = std::max({most, std::abs(now.h[k] - start.h[k]), std::abs(now.hu[k]), std::abs(now.hv[k])});
  }
  return most;
}

// references.md 2h. The surface lies below (an island) and above the bed's top, with each limiter.
TEST(Rest, LakeOverASmoothBedStaysToRoundOff) {
  for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee}) {
    for (double level : {0.2, 0.5}) {
      SolverSettings s = basin(50, 36, 0.04);
      s.limiter = limiter;
      Solver solver(s, ReferenceSurface::flat(2), {sample(s.grid, smooth_bed), {}});
      solver.set([&](double x, double y) { return FlowState{std::max(0.0, level - smooth_bed(x, y)), 0, 0}; });
      const Bits start = bits(solver);
      for (int k = 0; k < 200; ++k) solver.step(1);
      EXPECT_LT(departure(solver, start), 1e-13) << level;
    }
  }
}

TEST(Rest, LakeOverStepsOfAnyHeightStaysToRoundOff) {
  SolverSettings s = basin(40, 30, 0.05);
  StepBed bed{sample(s.grid, smooth_bed),
              {{"low", 0.2, 0.5, -0.3, 0.2, 0.1},
               {"high", 0.5, 0.9, -0.1, 0.3, 50},
               {"at the surface", 1.2, 1.6, -0.2, 0.2, 0.5},
               {"middle", 1.2, 1.4, 0.2, 0.5, 0.3}}};
  Solver solver(s, ReferenceSurface::flat(2), bed);
  const auto top = [&](double x, double y) {
    double t = 0;
    for (const auto& o : bed.obstacles) t = std::max(t, x >= o.x0 && x < o.x1 && y >= o.y0 && y < o.y1 ? o.height : 0.0);
    return t;
  };
  solver.set([&](double x, double y) { return FlowState{std::max(0.0, 0.5 - smooth_bed(x, y) - top(x, y)), 0, 0}; });
  const Bits start = bits(solver);
  for (int k = 0; k < 200; ++k) solver.step(1);
  EXPECT_LT(departure(solver, start), 1e-13);
}

// Any pile below yield keeps every bit: here with slopes up to 98 % of what friction holds, one dimension and two.
TEST(Rest, PileBelowYieldIsBitwiseStill) {
  const Closure closures[] = {quartz(), {EarthPressure::hydraulic(), std::tan(degrees(28)), true}};
  for (const Closure& closure : closures) {
    for (double zeta : {0.0, 15.0, 25.0}) {
      for (int ny : {1, 60}) {
        SolverSettings s;
        s.grid = {80, ny, 0.02, 0.02, 0, -0.01 * ny};
        s.closure = closure;
        s.block = 16;
        Solver solver(s, ReferenceSurface::incline(degrees(zeta), 1.6), {});
        const double steepest = std::max({closure.earth_pressure.x_active, closure.earth_pressure.y_active_active});
        const double spare = std::tan(degrees(28)) - std::tan(degrees(zeta));
        const double slope = 0.98 * spare / steepest;
        solver.set([&](double x, double y) {
          return FlowState{std::max(0.0, slope * (0.5 - std::hypot(x - 0.8, ny > 1 ? y : 0.0))), 0, 0};
        });
        const Bits start = bits(solver);
        for (int k = 0; k < 100; ++k) solver.step(1);
        EXPECT_EQ(bits(solver), start) << zeta << " deg, " << ny << " rows";
        EXPECT_GT(solver.steps(), 0);
      }
    }
  }
}

TEST(Rest, PileAboveYieldMovesAndThenRestsExactly) {
  for (int ny : {1, 40, 80}) {
    const double dx = ny == 80 ? 0.01 : 0.02;
    SolverSettings s;
    s.grid = {static_cast<int>(std::lround(1.2 / dx)), ny, dx, dx, 0, -0.5 * dx * ny};
    s.closure = quartz();
    s.block = 16;
    Solver solver(s, ReferenceSurface::incline(degrees(10), 1.2), {});
    solver.set([&](double x, double y) {
      return FlowState{std::max(0.0, 1.6 * (0.15 - std::hypot(x - 0.5, ny > 1 ? y : 0.0))), 0, 0};
    });
    const double volume = solver.volume();
    solver.advance_to(0.1);
    EXPECT_GT(solver.max_speed(), 0.05);
    solver.advance_to(1.5);
    EXPECT_EQ(solver.max_speed(), 0) << ny;
    const Bits rest = bits(solver);
    solver.advance_to(1.7);
    EXPECT_EQ(bits(solver), rest);
    EXPECT_NEAR(solver.volume(), volume + solver.budget().mass_boundary, 1e-14 * volume);
  }
}

// On a slope above its friction angle a heap leans on a wall, held by an earth pressure between active and passive. But for the
// film at its upper toe, which falls back as fast as it is smeared up, nothing moves any more.
TEST(Rest, AHeapLeaningOnAWallStays) {
  for (const int n : {100, 200}) {
    SolverSettings s;
    s.grid = {n, 1, 1.0 / n, 1.0 / n, 0, 0};
    s.sides = sides(Side::Kind::wall, Side::Kind::wall);
    s.closure = {EarthPressure::active_passive(degrees(37), degrees(24)), std::tan(degrees(24)), true};
    Solver solver(s, ReferenceSurface::incline(degrees(35), 1), {});
    solver.set([](double, double) { return FlowState{0.01, 0, 0}; });
    solver.advance_to(4);
    const Bits then = bits(solver);
    solver.advance_to(20);
    const Bits now = bits(solver);
    const double deepest = *std::ranges::max_element(then.h);
    EXPECT_GT(deepest, 0.05);
    int moving = 0;
    for (int i = 0; i < n; ++i) {
      if (now.hu[i] != 0) {
        ++moving;
        EXPECT_LT(now.h[i], 0.1 * deepest) << n << " cells, cell " << i;
      }
      if (then.h[i] > 0.25 * deepest) {
        EXPECT_EQ(now.h[i], then.h[i]) << n << " cells, cell " << i;
      }
    }
    EXPECT_LT(moving, 12) << n;
  }
}

// A deposit that lies locked is pushed by what arrives.
TEST(Rest, ArrivingFlowUnlocksADeposit) {
  SolverSettings s;
  s.grid = {100, 1, 0.02, 0.02, 0, 0};
  s.closure = {EarthPressure::hydraulic(), std::tan(degrees(28)), true};
  Solver solver(s, ReferenceSurface::incline(degrees(20), 2), {});
  solver.set([](double x, double) {
    if (x > 0.2 && x < 0.7) return FlowState{0.1, 0.3, 0};
    return FlowState{x > 1.0 && x < 1.4 ? std::min(0.001, 0.01 * std::min(x - 1, 1.4 - x)) : 0.0, 0, 0};
  });
  solver.advance_to(0.05);
  EXPECT_EQ(solver.at(60, 0).hu, 0);
  solver.advance_to(0.4);
  EXPECT_GT(solver.at(60, 0).hu, 0);
}

}  // namespace
}  // namespace couloir::test
