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

// Slower than its waves, into a dry, an empty and a filled basin: what is stated enters all the same; and where nothing hinders
// it the flow has the critical depth (q^2/g)^(1/3) at the side.
TEST(Boundary, ASlowInflowBringsWhatIsStated) {
  for (const double filled : {0.0, 0.02, 0.2}) {
    SolverSettings s = basin(200, 3, 0.02);
    s.sides[0] = {Side::Kind::inflow, 0.1, 0.3};  // Fr = 0.3
    s.sides[1].kind = filled > 0 ? Side::Kind::wall : Side::Kind::outflow;
    Solver solver(s, ReferenceSurface::flat(4), {});
    solver.set([=](double, double) { return FlowState{filled, 0, 0}; });
    const double before = solver.volume();
    solver.advance_to(1);
    const double asked = 0.1 * 0.3 * 1 * 0.06;
    EXPECT_NEAR(solver.budget().mass_inflow, asked, 1e-13 * asked) << filled;
    EXPECT_NEAR(solver.volume(), before + asked, 1e-13 * (before + asked)) << filled;
    EXPECT_GE(solver.min_depth(), 0);
    const double critical = std::cbrt(0.03 * 0.03 / 9.81);
    if (filled == 0) {
      EXPECT_NEAR(solver.at(0, 1).h, critical, 0.05 * critical);
    }
  }
}

// Faster than its waves, but the basin it fills rises over it.
TEST(Boundary, AFastInflowIsDrownedAndStillComesIn) {
  SolverSettings s = basin(50, 3, 0.02);
  s.sides[0] = {Side::Kind::inflow, 0.05, 2.0};
  Solver solver(s, ReferenceSurface::flat(1), {});
  solver.advance_to(8);
  const double asked = 0.05 * 2 * 8 * 0.06;
  EXPECT_NEAR(solver.volume(), asked, 1e-12 * asked);
  EXPECT_GT(solver.at(0, 1).h, 0.6);
}

// Depth rises from 20 to 60 mm in 0.3 s at 2 m/s (Fr > 2.6: all of it enters) and ends: what is inside is the integral.
TEST(Boundary, AHydrographFillsWithItsIntegral) {
  for (const int n : {100, 200}) {
    SolverSettings s = basin(n, 2, 2.0 / n);
    s.sides[0].kind = Side::Kind::inflow;
    s.sides[0].hydrograph = {{0.1, 0.02, 2.0}, {0.4, 0.06, 2.0}};
    s.sides[1].kind = Side::Kind::outflow;
    Solver solver(s, ReferenceSurface::flat(2), {});
    solver.advance_to(0.1);
    EXPECT_EQ(solver.volume(), 0) << "nothing before the first row";
    solver.advance_to(0.6);
    const double width = 4.0 / n, whole = 0.04 * 2 * 0.3 * width;
    EXPECT_NEAR(solver.volume(), whole, 1e-13 * whole) << n;
    EXPECT_NEAR(solver.volume(), solver.budget().mass_boundary, 1e-14 * whole);
    EXPECT_EQ(solver.budget().mass_inflow, solver.budget().mass_boundary);
    const double then = solver.budget().mass_inflow;
    solver.advance_to(3);
    EXPECT_EQ(solver.budget().mass_inflow, then) << "shut after the last row: nothing in, nothing out";
    EXPECT_LT(solver.budget().mass_boundary, then);
    EXPECT_NEAR(solver.volume(), solver.budget().mass_boundary, 1e-14 * whole);
    EXPECT_GE(solver.min_depth(), 0);
    EXPECT_EQ(solver.budget().mass_clipped, 0);
  }
}

TEST(Boundary, AnInflowFromTheSideIsItsMirror) {
  const auto run = [](int side) {
    SolverSettings s = basin(24, 24, 0.05);
    s.sides[side].kind = Side::Kind::inflow;
    s.sides[side].hydrograph = {{0, 0.02, 1.0}, {0.2, 0.05, 2.0}, {0.5, 0.01, 0.1}};
    Solver solver(s, ReferenceSurface::flat(1.2), {});
    solver.advance_to(0.8);
    return solver;
  };
  const Solver low = run(0), high = run(1), left = run(2);
  for (int i = 0; i < 24; ++i) {
    EXPECT_EQ(low.at(i, 12).h, high.at(23 - i, 12).h);
    EXPECT_EQ(low.at(i, 12).hu, -high.at(23 - i, 12).hu);
    EXPECT_EQ(low.at(i, 12).h, left.at(12, i).h);
  }
}

TEST(Boundary, InflowAtATime) {
  Side side;
  side.kind = Side::Kind::inflow;
  side.hydrograph = {{1, 0.1, 2}, {3, 0.3, 0}};
  EXPECT_EQ(inflow_at(side, 0.999).depth, 0);
  EXPECT_EQ(inflow_at(side, 1, Moment::before).depth, 0);
  EXPECT_EQ(inflow_at(side, 1).depth, 0.1);
  EXPECT_DOUBLE_EQ(inflow_at(side, 1.5).depth, 0.15);
  EXPECT_DOUBLE_EQ(inflow_at(side, 1.5).velocity, 1.5);
  EXPECT_EQ(inflow_at(side, 3, Moment::before).depth, 0.3);
  EXPECT_EQ(inflow_at(side, 3).depth, 0);
  EXPECT_EQ(next_row(side, 0), 1);
  EXPECT_EQ(next_row(side, 1), 3);
  EXPECT_EQ(inflow_at(side, 3.001).depth, 0);
  EXPECT_GT(fastest_inflow(side, 9.81, 0), 2);
  EXPECT_EQ(fastest_inflow(side, 9.81, 4), 0);
  SolverSettings s = basin(8, 8, 0.1);
  s.sides[0] = side;
  s.sides[0].hydrograph[1].time = 1;
  EXPECT_THROW(Solver(s, ReferenceSurface::flat(0.8), {}), std::invalid_argument);
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
