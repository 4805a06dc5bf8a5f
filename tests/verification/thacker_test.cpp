#include "continuum/exact/thacker.hpp"

#include <gtest/gtest.h>

#include "convergence.hpp"

namespace couloir::test {
namespace {

// references.md 2e: one and a quarter periods of the plane motion, along x and along y.
TEST(Thacker, SwingsInTheBasin) {
  const exact::ThackerBasin basin{0.1, 1.0, 0.5, 9.81};
  const double t = 1.25 * 2 * pi / basin.omega();
  const auto run = [&](int n, bool along_x) {
    SolverSettings s = row(n, -2, 4, Side::Kind::outflow);
    if (!along_x) {
      s.grid = {1, n, 4.0 / n, 4.0 / n, 0, -2};
      s.sides = sides(Side::Kind::wall, Side::Kind::outflow);
    }
    StepBed bed;
    for (int k = 0; k < n; ++k) bed.elevation.push_back(basin.bed(-2 + (k + 0.5) * 4 / n));
    Solver solver(s, ReferenceSurface::flat(4), bed);
    solver.set([&](double x, double y) { return FlowState{basin.depth(along_x ? x : y, 0), 0, 0}; });
    const double volume = solver.volume();
    solver.advance_to(t);
    EXPECT_NEAR(solver.volume(), volume, 1e-13);
    EXPECT_GE(solver.min_depth(), 0);
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double depth = along_x ? solver.at(k, 0).h : solver.at(0, k).h;
      sum += std::abs(depth - basin.depth(-2 + (k + 0.5) * 4 / n, t)) * 4 / n;
    }
    return sum;
  };
  const double e100 = run(100, true), e200 = run(200, true), e400 = run(400, true);
  std::printf("Thacker: L1 %.3e %.3e %.3e, orders %.2f %.2f\n", e100, e200, e400, order(e100, e200), order(e200, e400));
  EXPECT_GT(order(e100, e400, 4), 0.9);
  EXPECT_LT(e400, 0.005 * basin.h0 * basin.a * 4 / 3);
  EXPECT_EQ(run(100, false), e100);
}

}  // namespace
}  // namespace couloir::test
