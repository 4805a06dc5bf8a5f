#include "coupling/loop/gauges.hpp"

#include <gtest/gtest.h>

#include "continuum/noc/nested_noc.hpp"
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

// On refined grids the finest cells are read, the others where those are not.
TEST(Gauge, ReadsTheFinestCells) {
  SolverSettings settings;
  settings.grid = {20, 20, 0.1, 0.1, 0, -1};
  settings.refinement.boxes.push_back({0.8, 1.2, -0.2, 0.2, 1, 0});
  NestedNoc flow(settings, ReferenceSurface::flat(2), {});
  flow.set([](double x, double y) { return FlowState{1 + x * x + 0.1 * y, 0, 0}; });
  const auto depth = [&](double x, double y, double length, double width) {
    return read_gauge(flow, {"g", x, y, length, width}, 1e-6).depth;
  };
  EXPECT_NEAR(depth(0.9, 0, 0.2, 0.1), 1 + 1.075 * 1.075 + 0.0025, 1e-12);
  EXPECT_NEAR(depth(0.3, 0, 0.2, 0.1), 1 + 0.45 * 0.45 + 0.005, 1e-12);
  EXPECT_NEAR(depth(0.7, 0, 0.4, 0.1), 1 + 1.075 * 1.075 + 0.0025, 1e-12) << "over the patch's edge";
  EXPECT_NEAR(depth(0.7, 0, 0.08, 0.1), 1 + 0.75 * 0.75 + 0.005, 1e-12) << "beside the patch";
  EXPECT_NEAR(depth(1.01, 0.01, 0.002, 0.002), 1 + 1.025 * 1.025 + 0.0025, 1e-12) << "within one cell";
  EXPECT_NEAR(depth(1.025, 0.025, 0, 0), 1 + 1.025 * 1.025 + 0.0025, 1e-12);
  EXPECT_NEAR(depth(0.45, 0.05, 0, 0), 1 + 0.45 * 0.45 + 0.005, 1e-12);
  EXPECT_NEAR(depth(5, 0.06, 0.1, 0), 1 + 1.95 * 1.95 + 0.005, 1e-12) << "beyond the domain";
}

}  // namespace
}  // namespace couloir
