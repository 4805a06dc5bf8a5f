#include <gtest/gtest.h>

#include "scenes.hpp"

namespace couloir::test {
namespace {

TEST(Boundary, PeriodicFlowComesRound) {
  SolverSettings s = basin(50, 20, 0.02);
  s.sides = sides(Side::Kind::periodic, Side::Kind::periodic);
  s.limiter = Limiter::van_leer;
  s.gravity = 1e-12;  // pure advection
  Solver solver(s, ReferenceSurface::flat(1), {});
  const auto h = [](double x, double y) { return 1 + 0.2 * std::sin(2 * pi * x) * std::cos(5 * pi * y); };
  solver.set([&](double x, double y) { return FlowState{h(x, y), h(x, y) * 1.0, h(x, y) * 0.4}; });
  const double volume = solver.volume();
  solver.advance_to(1);
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(solver.at(i, 7).h, h(s.grid.x(i), s.grid.y(7)), 0.04);
  EXPECT_NEAR(solver.volume(), volume, 1e-13);
  EXPECT_NEAR(solver.budget().mass_boundary, 0, 1e-13);
}

TEST(Boundary, OutflowLetsOutButNeverIn) {
  SolverSettings s = basin(60, 3, 0.02);
  s.sides[0].kind = s.sides[1].kind = Side::Kind::outflow;
  Solver solver(s, ReferenceSurface::incline(degrees(30), 1.2), {});
  solver.set([](double, double) { return FlowState{0.1, 0.05, 0}; });
  double last = solver.volume();
  for (int k = 0; k < 300; ++k) {
    solver.step(0.01);
    EXPECT_LE(solver.volume(), last * (1 + 1e-15));
    last = solver.volume();
  }
  EXPECT_LT(last, 1e-3);
  EXPECT_GE(solver.min_depth(), 0);
  EXPECT_EQ(solver.budget().mass_clipped, 0);
}

TEST(Boundary, InflowFillsWithWhatItIsGiven) {
  SolverSettings s = basin(60, 3, 0.02);
  s.sides[0] = {Side::Kind::inflow, 0.05, 2.0};
  s.sides[1].kind = Side::Kind::outflow;
  Solver solver(s, ReferenceSurface::flat(1.2), {});
  solver.advance_to(0.2);  // Fr = 2.9: all of it enters
  EXPECT_NEAR(solver.volume(), 0.05 * 2 * 0.2 * 0.06, 0.01 * 0.05 * 2 * 0.2 * 0.06);
  solver.advance_to(3);
  EXPECT_NEAR(solver.at(30, 1).h, 0.05, 1e-9);
  EXPECT_NEAR(solver.at(30, 1).hu, 0.1, 1e-9);
}

TEST(Boundary, WallsKeepAll) {
  Solver solver(basin(30, 30, 0.03), ReferenceSurface::flat(0.9), {});
  solver.set([](double x, double y) { return FlowState{0.01 + 0.2 * std::exp(-30 * (x * x + y * y)), 0, 0}; });
  const double volume = solver.volume();
  solver.advance_to(3);
  EXPECT_NEAR(solver.volume(), volume, 1e-14);
  EXPECT_EQ(solver.budget().mass_boundary, 0);
}

TEST(Boundary, PeriodicNeedsBothSides) {
  SolverSettings s = basin(8, 8, 0.1);
  s.sides[2].kind = Side::Kind::periodic;
  EXPECT_THROW(Solver(s, ReferenceSurface::flat(1), {}), std::invalid_argument);
}

}  // namespace
}  // namespace couloir::test
