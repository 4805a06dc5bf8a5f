#include <gtest/gtest.h>

#include "scenes.hpp"

namespace couloir::test {
namespace {

// A channel along x, closed at both ends, with a sill or wall across it at x in [1, 1.2).
Solver channel_with_sill(double height, double depth, double velocity, int ny = 2) {
  SolverSettings s = basin(100, ny, 0.02);
  Solver solver(s, ReferenceSurface::flat(2), {{}, {{"sill", 1.0, 1.2, -9, 9, height}}});
  solver.set([&](double x, double) { return x < 1 ? FlowState{depth, depth * velocity, 0} : FlowState{}; });
  return solver;
}

double behind(const Solver& s) {
  double most = 0;
  for (int i = 50; i < s.grid().nx; ++i) most = std::max(most, s.at(i, 0).h);
  return most;
}

TEST(Step, WallAboveTheHeadHoldsAll) {
  Solver solver = channel_with_sill(10, 0.2, 3);
  solver.advance_to(2);
  EXPECT_EQ(behind(solver), 0);
  EXPECT_GE(solver.min_depth(), 0);
}

TEST(Step, MaterialPassesOnlyWhenTheHeadReachesOver) {
  Solver below = channel_with_sill(0.201, 0.2, 0);
  below.advance_to(1);
  EXPECT_EQ(behind(below), 0);
  Solver above = channel_with_sill(0.15, 0.2, 0);
  above.advance_to(0.3);
  EXPECT_GT(above.at(55, 0).h, 0);
  EXPECT_GT(above.at(62, 0).h, 0);
  Solver hit = channel_with_sill(0.25, 0.2, 3);  // a jump at the wall lifts the head over the sill
  hit.advance_to(0.3);
  EXPECT_GT(behind(hit), 0.01);
}

// At rest the force on the upstream face is K g' h^2/2 per width, for a sill below the surface g'(h^2 - h*^2)/2.
TEST(Step, ForceAtRestIsThePressure) {
  Solver wall = channel_with_sill(10, 0.2, 0);
  wall.advance_to(1);
  EXPECT_NEAR(wall.obstacle_impulse(0)[0] / wall.time(), 0.04 * 0.5 * 9.81 * 0.04, 1e-14);
  EXPECT_EQ(wall.obstacle_impulse(0)[1], 0);

  SolverSettings s = basin(20, 3, 0.1);
  Solver lake(s, ReferenceSurface::flat(2), {{}, {{"end", 1.0, 9, -9, 9, 0.3}}});
  lake.set([](double x, double) { return FlowState{x < 1 ? 0.5 : 0.2, 0, 0}; });
  lake.advance_to(1);
  EXPECT_NEAR(lake.obstacle_impulse(0)[0], 0.3 * 0.5 * 9.81 * (0.25 - 0.04), 1e-13);
}

TEST(Step, MaterialOnTopFallsOffBothSides) {
  SolverSettings s = basin(40, 1, 0.05);
  Solver solver(s, ReferenceSurface::flat(2), {{}, {{"block", 0.8, 1.2, -9, 9, 0.4}}});
  solver.set([](double x, double) { return FlowState{x > 0.8 && x < 1.2 ? 0.1 : 0, 0, 0}; });
  solver.advance_to(3);
  EXPECT_LT(solver.at(20, 0).h, 0.01);
  EXPECT_GT(solver.at(10, 0).h, 0.01);
  EXPECT_EQ(solver.obstacle_impulse(0)[1], 0);
  EXPECT_GE(solver.min_depth(), 0);
  EXPECT_NEAR(solver.volume(), 0.04 * 0.05, 1e-16);
}

}  // namespace
}  // namespace couloir::test
