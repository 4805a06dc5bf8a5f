#include "coupling/loop/gauges.hpp"

#include <gtest/gtest.h>

#include "continuum/solver.hpp"

namespace couloir {
namespace {

// 10 x 6 cells of 0.1 m around y = 0, the depth rising along both directions.
Solver rising_flow() {
  SolverSettings settings;
  settings.grid = {10, 6, 0.1, 0.1, 0, -0.3};
  Solver solver(settings, ReferenceSurface::flat(1), {});
  solver.set([](double x, double y) { return FlowState{1 + x + 0.1 * y, 2 * (1 + x + 0.1 * y), 0}; });
  return solver;
}

TEST(Gauge, PointIsInterpolated) {
  const GaugeReading r = read_gauge(rising_flow(), {"p", 0.5, 0.02, 0, 0}, 1e-6);
  EXPECT_NEAR(r.depth, 1.502, 1e-12);
  EXPECT_NEAR(r.velocity_along, 2, 1e-12);
}

TEST(Gauge, RectangleHasTheDeepestCellWithEdgesIncluded) {
  const Solver flow = rising_flow();
  EXPECT_NEAR(read_gauge(flow, {"r", 0.2, 0, 0.3, 0.4}, 1e-6).depth, 1 + 0.45 + 0.015, 1e-12);
  EXPECT_NEAR(read_gauge(flow, {"edge", 0.2, 0, 0.35, 0.5}, 1e-6).depth, 1 + 0.55 + 0.025, 1e-12);
  EXPECT_NEAR(read_gauge(flow, {"within one cell", 0.31, 0.04, 0.02, 0.02}, 1e-6).depth, 1 + 0.35 + 0.005, 1e-12);
}

TEST(Gauge, ThinFlowHasNoVelocity) {
  const Solver flow = rising_flow();
  const double depth = read_gauge(flow, {"p", 0.5, 0.02, 0, 0}, 1).depth;
  EXPECT_EQ(read_gauge(flow, {"p", 0.5, 0.02, 0, 0}, depth).velocity_along, 0);
  EXPECT_GT(read_gauge(flow, {"p", 0.5, 0.02, 0, 0}, 0.999 * depth).velocity_along, 0);
}

}  // namespace
}  // namespace couloir
