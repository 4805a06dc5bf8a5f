// Refined meshes read by place.

#include <gtest/gtest.h>

#include "refined.hpp"

namespace couloir::test {
namespace {

// Cells of 0.1, in x from 0.8 to 2.4 of 0.05, there from 1.2 to 2 of 0.025.
Solver mesh(const std::function<FlowState(double, double)>& state) {
  SolverSettings s = basin(32, 16, 0.1);
  s.block = 4;
  s.refinement.boxes.push_back({1.3, 1.9, -0.3, 0.3, 2, 0});
  Solver solver(s, ReferenceSurface::flat(3.2), {});
  solver.set(state);
  return solver;
}

FlowState linear(double x, double y) {
  return {2 + x - 0.5 * y, 0.3 * x, 0.1 * y + x};
}

TEST(RefinedReading, InterpolatesALinearFieldExactlyAcrossLevels) {
  const Solver s = mesh(linear);
  ASSERT_GT(s.blocks().size(), 32u);
  for (double x = 0.06; x < 3.15; x += 0.0137) {
    for (double y = -0.74; y < 0.75; y += 0.0531) {
      const FlowState q = s.interpolated(x, y), exact = linear(x, y);
      ASSERT_NEAR(q.h, exact.h, 1e-12) << x << " " << y;
      ASSERT_NEAR(q.hu, exact.hu, 1e-12) << x << " " << y;
      ASSERT_NEAR(q.hv, exact.hv, 1e-12) << x << " " << y;
    }
  }
  EXPECT_NEAR(s.interpolated(-1, 0.05).h, linear(0.05, 0.05).h, 1e-12) << "beyond the last centres as on them";
}

TEST(RefinedReading, FinestCellsFillTheDomainOnce) {
  const Solver s = mesh(linear);
  const Grid& g = s.grid();
  std::size_t cells = 0, seen = 0;
  for (const BlockPlace& b : s.blocks()) cells += std::size_t(b.nx) * b.ny;
  s.for_finest(g.x0, g.x0 + g.nx * g.dx, g.y0, g.y0 + g.ny * g.dy, [&](const FlowModel::Sample& q) {
    ++seen;
    ASSERT_NEAR(q.q.h, linear(q.x, q.y).h, 1e-12);
  });
  EXPECT_EQ(seen, cells);
}

TEST(RefinedReading, RectanglesTakeTheCellsOfEachSize) {
  const Solver s = mesh(linear);
  const auto count = [&](double x0, double x1, double y0, double y1) {
    int n = 0;
    s.for_finest(x0, x1, y0, y1, [&](const FlowModel::Sample&) { ++n; });
    return n;
  };
  EXPECT_EQ(count(0, 0.2, 0, 0.1), 2) << "coarsest cells";
  EXPECT_EQ(count(1.4, 1.6, 0, 0.1), 32) << "finest";
  EXPECT_EQ(count(1.401, 1.402, 0.001, 0.002), 1) << "within one cell: that one";
  EXPECT_EQ(count(0.301, 0.302, 0.001, 0.002), 1);
  EXPECT_EQ(count(5, 6, 0.001, 0.002), 1) << "beyond the domain: the nearest";
}

}  // namespace
}  // namespace couloir::test
