// Smooth and broken waves across a jump in the size of the cells.

#include <gtest/gtest.h>

#include "refined.hpp"

namespace couloir::test {
namespace {

// A travelling hump in a periodic flat basin, its own exact solution at this order: the fine uniform grid's.
Solver hump(int n, int levels, double t) {
  SolverSettings s = basin(n, n / 2, 1.0 / n);
  s.sides = sides(Side::Kind::periodic, Side::Kind::periodic);
  s.limiter = Limiter::van_leer;
  s.block = std::max(8, n / 8);
  if (levels > 0) s = refined(s, {0.375, 0.75, -0.125, 0.125, levels, 0});
  Solver solver(s, ReferenceSurface::flat(1), {});
  solver.set([](double x, double y) {
    const double h = 0.1 + 0.01 * std::sin(2 * pi * x) * std::cos(4 * pi * y);
    return FlowState{h, 0.8 * h, 0.1 * h};
  });
  solver.advance_to(t);
  return solver;
}

// Mean over the cells of a coarser grid.
double error(const Solver& s, const Solver& fine) {
  const int ratio = fine.grid().nx / s.grid().nx;
  double sum = 0;
  for (int j = 0; j < s.grid().ny; ++j) {
    for (int i = 0; i < s.grid().nx; ++i) {
      double h = 0;
      for (int m = 0; m < ratio; ++m) {
        for (int k = 0; k < ratio; ++k) h += fine.at(ratio * i + k, ratio * j + m).h;
      }
      sum += std::abs(s.at(i, j).h - h / (ratio * ratio));
    }
  }
  return sum / (s.grid().nx * s.grid().ny);
}

TEST(RefinedOrder, SmoothWavesKeepTheSecondOrder) {
  const double t = 0.3;
  const Solver exact = hump(512, 0, t);
  const double e1 = error(hump(32, 1, t), exact), e2 = error(hump(64, 1, t), exact), e3 = error(hump(128, 1, t), exact);
  const double u1 = error(hump(32, 0, t), exact), u3 = error(hump(128, 0, t), exact);
  EXPECT_GT(std::log2(e1 / e2), 1.6);
  EXPECT_GT(std::log2(e2 / e3), 1.6);
  EXPECT_LT(e1, u1);
  EXPECT_LT(e3, u3);
}

TEST(RefinedOrder, AShockCrossesAJump) {
  const auto run = [](int levels) {
    SolverSettings s = basin(128, 16, 1.0 / 128);
    s.block = 8;
    if (levels > 0) s = refined(s, {0.5, 0.75, -0.1, 0.1, levels, 0});
    Solver solver(s, ReferenceSurface::flat(1), {});
    solver.set([](double x, double) { return FlowState{x < 0.3 ? 0.1 : 0.02, 0, 0}; });
    solver.advance_to(0.55);  // the shock, at 0.94 m/s, is through the finer cells
    return solver;
  };
  const Solver coarse = run(0), two = run(1), three = run(2);
  double most = 0;
  for (int i = 0; i < 128; ++i) most = std::max({most, three.at(i, 8).h, two.at(i, 8).h});
  EXPECT_LT(most, 0.1 + 1e-12);
  // Between rarefaction and shock lies a plateau. A shock that widens as it leaves the finer cells sends a small wave back.
  const double plateau = coarse.at(80, 8).h;
  for (int i = 76; i < 100; ++i) {
    EXPECT_NEAR(two.at(i, 8).h, plateau, 0.02 * plateau) << i;
    EXPECT_NEAR(three.at(i, 8).h, plateau, 0.02 * plateau) << i;
  }
  EXPECT_LT(mean_difference(coarse, three), 4e-4);
}

}  // namespace
}  // namespace couloir::test
