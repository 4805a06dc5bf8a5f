#include <gtest/gtest.h>

#include "noc_scenes.hpp"

namespace couloir::test {
namespace {

const Limiter all_limiters[] = {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee, Limiter::eno};

void expect_closed(const NocSolver& s, double volume, std::array<double, 2> momentum) {
  const Budget& b = s.budget();
  EXPECT_NEAR(s.volume(), volume + b.mass_boundary, 2e-13 * volume);
  EXPECT_EQ(b.mass_clipped, 0);
  const auto now = s.momentum();
  for (int k : {0, 1}) {
    const double terms[] = {b.gravity[k], b.friction[k], b.boundary[k], b.obstacles[k], b.cutoff[k]};
    double sum = 0, scale = 0;
    for (double t : terms) sum += t, scale += std::abs(t);
    EXPECT_NEAR(now[k] - momentum[k], sum, 1e-12 * scale) << k;
  }
}

// Slope, arc, earth pressure, friction, a bump, onto dry ground, with each limiter.
TEST(NocConservation, WallsAndPeriodicSidesKeepMassToRoundOff) {
  const std::array<Side, 4> closed[] = {sides(Side::Kind::wall, Side::Kind::wall), sides(Side::Kind::wall, Side::Kind::periodic)};
  for (const auto& s4 : closed) {
    for (Limiter limiter : all_limiters) {
      NocSolver s = heap_on_bump(1, s4, 1, limiter);
      const double volume = s.volume();
      const auto momentum = s.momentum();
      s.advance_to(1.5);
      EXPECT_NEAR(s.volume(), volume, 1e-13 * volume);
      EXPECT_EQ(s.budget().mass_boundary, 0);
      EXPECT_GE(s.min_depth(), 0);
      expect_closed(s, volume, momentum);
      std::printf("limiter %d: drift %.1e, limited %ld of %ld, cutoff/momentum passed %.1e\n", static_cast<int>(limiter),
                  s.volume() / volume - 1, s.limited(), s.cell_updates(), s.budget().cutoff[0] / s.budget().gravity[0]);
    }
  }
}

TEST(NocConservation, PeriodicAllRound) {
  SolverSettings s = basin(40, 30, 0.05);
  s.sides = sides(Side::Kind::periodic, Side::Kind::periodic);
  s.closure = quartz();
  NocBed bed;
  bed.ground = [](double x, double y) { return 0.05 * std::sin(pi * x) * std::cos(4 * pi * y / 1.5); };
  NocSolver solver(s, ReferenceSurface::incline(degrees(33), 2), bed);
  solver.set([](double x, double y) {
    const double h = std::max(0.0, 0.2 - (x - 1.8) * (x - 1.8) - (y - 0.5) * (y - 0.5));
    return FlowState{h, h, -0.5 * h};
  });
  const double volume = solver.volume();
  const auto momentum = solver.momentum();
  solver.advance_to(1.5);
  expect_closed(solver, volume, momentum);
  EXPECT_EQ(solver.budget().mass_boundary, 0);
  EXPECT_EQ(solver.budget().boundary[0], 0);
}

TEST(NocConservation, BudgetClosesWithOpenSidesAndAnObstacle) {
  NocSolver s = heap_on_bump(1);
  const double volume = s.volume();
  const auto momentum = s.momentum();
  s.advance_to(0.4);
  expect_closed(s, volume, momentum);
  EXPECT_LT(s.budget().obstacles[0], 0);
  EXPECT_NEAR(s.budget().obstacles[0], -s.obstacle_impulse(0)[0], 1e-15);
  EXPECT_NEAR(s.budget().obstacles[1], -s.obstacle_impulse(0)[1], 1e-15);
  s.advance_to(2);
  expect_closed(s, volume, momentum);
  EXPECT_LT(s.budget().mass_boundary, 0);
  s.reset_budget();
  const double rest = s.volume();
  const auto then = s.momentum();
  s.advance_to(2.2);
  expect_closed(s, rest, then);
}

TEST(NocConservation, OutflowLetsOutButNeverIn) {
  for (double zeta : {30.0, 0.0}) {
    SolverSettings s = basin(60, 3, 0.02);
    s.sides[0].kind = s.sides[1].kind = Side::Kind::outflow;
    NocSolver solver(s, ReferenceSurface::incline(degrees(zeta), 1.2), {});
    solver.set([](double, double) { return FlowState{0.1, 0.0, 0}; });
    double last = solver.volume();
    const double first = last;
    for (int k = 0; k < 400; ++k) {
      solver.step(0.01);
      ASSERT_LE(solver.volume(), last * (1 + 1e-15)) << k;
      last = solver.volume();
    }
    EXPECT_GE(solver.min_depth(), 0);
    EXPECT_NEAR(last, first + solver.budget().mass_boundary, 1e-13 * first);
    if (zeta > 0) {
      EXPECT_LT(last, 0.02 * first);
    } else {
      EXPECT_NEAR(last, first, 1e-13 * first);
    }
  }
}

TEST(NocConservation, InflowFillsWithWhatItIsGiven) {
  SolverSettings s = basin(60, 3, 0.02);
  s.sides[0] = {Side::Kind::inflow, 0.05, 2.0};
  s.sides[1].kind = Side::Kind::outflow;
  NocSolver solver(s, ReferenceSurface::flat(1.2), {});
  solver.advance_to(0.2);  // Fr = 2.9: all of it enters
  EXPECT_NEAR(solver.volume(), 0.05 * 2 * 0.2 * 0.06, 1e-12);
  EXPECT_NEAR(solver.volume(), solver.budget().mass_boundary, 1e-13 * solver.volume());
  solver.advance_to(3);
  EXPECT_NEAR(solver.at(30, 1).h, 0.05, 1e-9);
  EXPECT_NEAR(solver.at(30, 1).hu, 0.1, 1e-9);
}

// Slower than its waves, into a dry and into a filled basin: what is stated enters all the same.
TEST(NocConservation, ASlowInflowBringsWhatIsStated) {
  for (const double filled : {0.0, 0.02, 0.2}) {
    SolverSettings s = basin(200, 3, 0.02);
    s.sides[0] = {Side::Kind::inflow, 0.1, 0.3};  // Fr = 0.3
    s.sides[1].kind = filled > 0 ? Side::Kind::wall : Side::Kind::outflow;
    NocSolver solver(s, ReferenceSurface::flat(4), {});
    solver.set([=](double, double) { return FlowState{filled, 0, 0}; });
    const double before = solver.volume();
    solver.advance_to(1);
    const double asked = 0.1 * 0.3 * 1 * 0.06;
    EXPECT_NEAR(solver.budget().mass_inflow, asked, 1e-12 * asked) << filled;
    EXPECT_NEAR(solver.volume(), before + asked, 1e-12 * (before + asked)) << filled;
    EXPECT_GE(solver.min_depth(), 0);
  }
}

// However slow, and however fast the slope carries it off.
TEST(NocConservation, ATrickleOntoASlopeBringsWhatIsStated) {
  for (const double slope : {0.0, 30.0, 60.0}) {
    for (const double velocity : {0.001, 0.01, 0.1}) {
      SolverSettings s = basin(50, 2, 0.02);
      s.sides[0] = {Side::Kind::inflow, 0.02, velocity};
      s.sides[1].kind = Side::Kind::outflow;
      s.dry_depth = 2e-8;
      s.closure = quartz();
      NocSolver solver(s, ReferenceSurface::incline(degrees(slope), 1), {});
      solver.advance_to(1);
      const double asked = 0.02 * velocity * 0.04;
      EXPECT_NEAR(solver.budget().mass_inflow, asked, 1e-6 * asked) << slope << " deg, " << velocity << " m/s";
    }
  }
}

// Steps end at the hydrograph's rows, between which it is linear: what is asked for enters, and after it the side is shut.
TEST(NocConservation, HydrographGivesWhatItSaysAndThenShuts) {
  SolverSettings s = basin(100, 3, 0.02);
  s.sides[0].kind = Side::Kind::inflow;
  s.sides[0].hydrograph = {{0.1, 0.04, 2.0}, {0.3, 0.06, 2.0}, {0.4, 0.06, 2.0}};
  NocSolver solver(s, ReferenceSurface::flat(2), {});
  solver.advance_to(0.1);
  EXPECT_EQ(solver.volume(), 0);
  solver.advance_to(0.4);
  const double asked = (0.05 * 2 * 0.2 + 0.06 * 2 * 0.1) * 0.06;
  EXPECT_NEAR(solver.volume(), asked, 1e-12 * asked);
  EXPECT_NEAR(solver.volume(), solver.budget().mass_inflow, 1e-13 * asked);
  EXPECT_EQ(solver.budget().mass_inflow, solver.budget().mass_boundary);
  const auto bytes = solver.checkpoint();
  const double volume = solver.volume();
  solver.advance_to(1.5);
  EXPECT_NEAR(solver.volume(), volume, 1e-13 * volume);
  NocSolver again(s, ReferenceSurface::flat(2), {});
  again.restore(bytes);
  again.advance_to(1.5);
  EXPECT_EQ(bits_of(again), bits_of(solver));
}

TEST(NocConservation, SidesSumToTheBoundaryAndAWallHoldsALayer) {
  NocSolver s = heap_on_bump(1, sides(Side::Kind::wall, Side::Kind::wall));
  s.advance_to(0.8);
  const Budget& b = s.budget();
  for (int k : {0, 1}) {
    double sum = 0;
    for (const auto& side : b.sides) sum += side[k];
    EXPECT_NEAR(sum, b.boundary[k], 1e-14);
  }
  EXPECT_NEAR(b.sides[2][0], 0, 1e-17);  // a wall is smooth
  NocSolver layer(basin(20, 10, 0.05), ReferenceSurface::flat(1), {});
  layer.set([](double, double) { return FlowState{0.1, 0, 0}; });
  layer.advance_to(0.3);
  const double push = 0.5 * 9.81 * 0.1 * 0.1 * 0.3;
  EXPECT_NEAR(layer.budget().sides[0][0], push * 0.5, 1e-12);
  EXPECT_NEAR(layer.budget().sides[1][0], -push * 0.5, 1e-12);
  EXPECT_NEAR(layer.budget().sides[2][1], push * 1.0, 1e-12);
  EXPECT_NEAR(layer.budget().sides[3][1], -push * 1.0, 1e-12);
}

// Friction carries the weight of what stands still, the wall its pressure.
TEST(NocConservation, AWallBelowHoldsNoWeightThatFrictionHolds) {
  SolverSettings s = basin(20, 10, 0.05);
  s.closure.tan_delta = std::tan(degrees(31));
  NocSolver layer(s, ReferenceSurface::incline(degrees(30), 1), {});
  layer.set([](double, double) { return FlowState{0.1, 0, 0}; });
  layer.advance_to(0.3);
  const double push = 0.5 * 9.81 * std::cos(degrees(30)) * 0.1 * 0.1 * 0.3;
  EXPECT_NEAR(layer.budget().sides[0][0], push * 0.5, 1e-12);
  EXPECT_NEAR(layer.budget().sides[1][0], -push * 0.5, 1e-12);
  EXPECT_NEAR(layer.budget().sides[2][1], push, 1e-12);
  EXPECT_NEAR(layer.budget().friction[0], -9.81 * std::sin(degrees(30)) * layer.volume() * 0.3, 1e-12);
}

TEST(NocConservation, GaugesCountWhatCrosses) {
  NocSolver s = heap_on_bump(1);
  const int low = s.add_gauge(25, 0, 40), edge = s.add_gauge(32, 0, 40), out = s.add_gauge(60, 0, 40);
  const int left = s.add_gauge(32, 0, 20), right = s.add_gauge(32, 20, 40);
  const auto beyond = [&](int i0) {
    double sum = 0;
    for (int j = 0; j < 40; ++j) {
      for (int i = i0; i < 60; ++i) sum += s.at(i, j).h;
    }
    return sum * 0.02 / 64;
  };
  const double at25 = beyond(25), at32 = beyond(32);
  s.advance_to(1.2);
  EXPECT_NEAR(s.gauge(low), beyond(25) - at25 + s.gauge(out), 1e-15);
  EXPECT_NEAR(s.gauge(edge), beyond(32) - at32 + s.gauge(out), 1e-15);
  EXPECT_NEAR(s.gauge(edge), s.gauge(left) + s.gauge(right), 1e-15);
  EXPECT_NEAR(s.gauge(out), -s.budget().mass_boundary, 1e-15);
  EXPECT_GT(s.gauge(low), 1e-4);
  EXPECT_GT(s.gauge(out), 1e-6);
}

// A dam break in two dimensions onto a dry bed at the bound of the CFL number, diagonal to the cells.
TEST(NocConservation, DryBedStaysPositive) {
  for (Limiter limiter : all_limiters) {
    SolverSettings s = basin(60, 60, 0.02);
    s.cfl = 0.5;
    s.limiter = limiter;
    NocSolver solver(s, ReferenceSurface::flat(1.2), {});
    solver.set([](double x, double y) {
      const double h = x - 0.6 + y < 0 ? 0.1 : 0.0;
      return FlowState{h, 4 * h, 4 * h};
    });
    const double volume = solver.volume();
    solver.advance_to(0.4);
    EXPECT_GE(solver.min_depth(), 0);
    EXPECT_NEAR(solver.volume(), volume, 1e-13 * volume);
    EXPECT_LT(solver.max_speed(), 12);
    std::printf("limiter %d: limited %ld of %ld, fastest %.3f\n", static_cast<int>(limiter), solver.limited(),
                solver.cell_updates(), solver.max_speed());
  }
}

}  // namespace
}  // namespace couloir::test
