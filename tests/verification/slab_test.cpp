#include <gtest/gtest.h>

#include "continuum/exact/sliding_slab.hpp"
#include "convergence.hpp"

namespace couloir::test {
namespace {

Solver slab(double zeta, double delta, double u0) {
  SolverSettings s = row(20, 0, 2, Side::Kind::periodic);
  s.closure = {EarthPressure::active_passive(degrees(40), degrees(28)), std::tan(delta), true};
  Solver solver(s, ReferenceSurface::incline(zeta, 2), {});
  solver.set([&](double, double) { return FlowState{0.1, 0.1 * u0, 0}; });
  return solver;
}

// references.md 2a: speeding up, slowing down, frictionless.
TEST(Slab, SlidesToRoundOff) {
  for (double delta : {0.0, 20.0, 40.0}) {
    const double zeta = degrees(30), mu = std::tan(degrees(delta));
    Solver s = slab(zeta, degrees(delta), 2);
    s.advance_to(0.5);
    EXPECT_NEAR(s.at(7, 0).hu, 0.1 * exact::sliding_slab_velocity(0.5, 2, 9.81, zeta, mu), 1e-13) << delta;
    EXPECT_NEAR(s.at(7, 0).h, 0.1, 1e-14);
  }
}

TEST(Slab, StopsAndStaysStopped) {
  Solver s = slab(degrees(20), degrees(28), 0.5);
  s.advance_to(1);
  EXPECT_EQ(s.max_speed(), 0);
}

// On the arc the curvature term alone: a thin, fast layer loses du/dx = -mu kappa u beside gravity and friction.
TEST(Slab, CurvatureAddsToFriction) {
  const auto speed_after = [](bool curvature) {
    SolverSettings s = row(200, 0, 2, Side::Kind::outflow);
    s.closure = {EarthPressure::hydraulic(), std::tan(degrees(20)), curvature};
    s.gravity = 1e-9;
    Solver solver(s, ReferenceSurface::chute(degrees(40), 0.5, 1.0, 0.5), {});
    solver.set([](double x, double) { return FlowState{x < 0.5 ? 0.01 : 0, x < 0.5 ? 0.05 : 0, 0}; });
    solver.advance_to(0.35);
    return solver.at(190, 0).hu / solver.at(190, 0).h;
  };
  EXPECT_NEAR(speed_after(false), 5, 1e-6);
  EXPECT_NEAR(speed_after(true), 5 * std::exp(-std::tan(degrees(20)) * degrees(40)), 0.01);
}

}  // namespace
}  // namespace couloir::test
