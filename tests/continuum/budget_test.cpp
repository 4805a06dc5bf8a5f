#include <gtest/gtest.h>

#include "scenes.hpp"

namespace couloir::test {
namespace {

void expect_closed(const Solver& s, double volume, std::array<double, 2> momentum) {
  const Budget& b = s.budget();
  EXPECT_NEAR(s.volume(), volume + b.mass_boundary + b.mass_zone + b.mass_clipped, 1e-13 * volume);
  const auto now = s.momentum();
  for (int k : {0, 1}) {
    const double terms[] = {b.gravity[k], b.friction[k], b.boundary[k], b.zone[k], b.obstacles[k], b.cutoff[k]};
    double sum = 0, scale = 0;
    for (double t : terms) sum += t, scale += std::abs(t);
    EXPECT_NEAR(now[k] - momentum[k], sum, 1e-12 * scale) << k;
  }
}

// Slope, arc, earth pressure, friction, obstacle, walls and outflow all at once.
TEST(Budget, ClosesToRoundOff) {
  Solver s = heap_on_block(1);
  const double volume = s.volume();
  const auto momentum = s.momentum();
  s.advance_to(0.4);
  expect_closed(s, volume, momentum);
  EXPECT_EQ(s.budget().mass_clipped, 0);
  EXPECT_GE(s.min_depth(), 0);
  EXPECT_LT(s.budget().obstacles[0], 0);
  EXPECT_NEAR(s.budget().obstacles[0], -s.obstacle_impulse(0)[0], 1e-15);
  EXPECT_NEAR(s.budget().obstacles[1], -s.obstacle_impulse(0)[1], 1e-15);
  s.advance_to(2);
  expect_closed(s, volume, momentum);
  EXPECT_LT(s.budget().mass_boundary, 0);
}

TEST(Budget, ClosesOverASmoothBed) {
  SolverSettings s = basin(40, 40, 0.05);
  s.closure = quartz();
  StepBed bed;
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 40; ++i) bed.elevation.push_back(0.1 * std::sin(4 * s.grid.x(i)) * std::cos(3 * s.grid.y(j)));
  }
  Solver solver(s, ReferenceSurface::incline(degrees(32), 2), bed);
  solver.set([](double x, double y) { return FlowState{std::max(0.0, 0.2 - x * x - (y - 0.3) * (y - 0.3)), 0, 0}; });
  const double volume = solver.volume();
  solver.advance_to(0.7);
  expect_closed(solver, volume, {0, 0});
  EXPECT_NE(solver.budget().gravity[1], 0);
}

TEST(Budget, ResetStartsAnew) {
  Solver s = heap_on_block(1);
  s.advance_to(0.1);
  s.reset_budget();
  const double volume = s.volume();
  const auto momentum = s.momentum();
  s.advance_to(0.3);
  expect_closed(s, volume, momentum);
}

TEST(Gauge, CountsTheVolumeThatCrosses) {
  Solver s = heap_on_block(1);
  const int low = s.add_gauge(25, 0, 40), edge = s.add_gauge(32, 0, 40), out = s.add_gauge(60, 0, 40);
  const int left = s.add_gauge(32, 0, 20), right = s.add_gauge(32, 20, 40);
  const auto beyond = [&](int i0) {
    double sum = 0;
    for (int j = 0; j < 40; ++j) {
      for (int i = i0; i < 60; ++i) sum += s.at(i, j).h;
    }
    return sum * 0.02 * 0.02;
  };
  const double at25 = beyond(25), at32 = beyond(32);
  s.advance_to(0.8);
  EXPECT_NEAR(s.gauge(low), beyond(25) - at25 + s.gauge(out), 1e-15);
  EXPECT_NEAR(s.gauge(edge), beyond(32) - at32 + s.gauge(out), 1e-15);
  EXPECT_NEAR(s.gauge(edge), s.gauge(left) + s.gauge(right), 1e-15);
  EXPECT_NEAR(s.gauge(out), -s.budget().mass_boundary, 1e-15);
  EXPECT_GT(s.gauge(low), 1e-4);
}

// What falls into cells is in the budget, films' momentum as cut off; the cells' earth pressure stays what it was.
TEST(Budget, KnowsWhatFallsFromAbove) {
  Solver s = heap_on_block(1);
  s.advance_to(0.1);
  const auto k = s.earth_pressure(15, 20);
  s.reset_budget();
  const double volume = s.volume();
  const auto momentum = s.momentum();
  const FlowState before = s.at(15, 20);
  s.add(15, 20, {0.01, 0.02, -0.005});
  s.add(3, 3, {1e-9, 1e-9, 0});
  EXPECT_DOUBLE_EQ(s.at(15, 20).h, before.h + 0.01);
  EXPECT_DOUBLE_EQ(s.at(15, 20).hu, before.hu + 0.02);
  EXPECT_EQ(s.at(3, 3).hu, 0) << "thinner than the dry depth";
  EXPECT_EQ(s.earth_pressure(15, 20), k);
  const double area = 0.02 * 0.02;
  EXPECT_NEAR(s.budget().mass_added, area * (0.01 + 1e-9), 1e-20);
  EXPECT_NEAR(s.budget().added[0], area * (0.02 + 1e-9), 1e-20);
  EXPECT_NEAR(s.budget().cutoff[0], -area * 1e-9, 1e-22);
  for (int n = 0; n < 20; ++n) s.step(0.002);
  const Budget& b = s.budget();
  EXPECT_NEAR(s.volume(), volume + b.mass_added + b.mass_boundary, 1e-13 * volume);
  for (int q : {0, 1}) {
    const double sum = b.gravity[q] + b.friction[q] + b.boundary[q] + b.obstacles[q] + b.added[q] + b.cutoff[q];
    EXPECT_NEAR(s.momentum()[q] - momentum[q], sum, 1e-13 * std::abs(b.gravity[0])) << q;
  }
  EXPECT_THROW(s.add(60, 3, {}), std::out_of_range);
}

}  // namespace
}  // namespace couloir::test
