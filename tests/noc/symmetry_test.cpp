#include <gtest/gtest.h>

#include "noc_scenes.hpp"

namespace couloir::test {
namespace {

TEST(NocSymmetry, MirroredSceneGivesMirroredBits) {
  for (Side::Kind across : {Side::Kind::wall, Side::Kind::periodic, Side::Kind::outflow}) {
    for (Limiter limiter : {Limiter::minmod, Limiter::superbee, Limiter::eno}) {
      const auto s4 = sides(Side::Kind::outflow, across);
      NocSolver one = heap_on_bump(1, s4, 1, limiter), other = heap_on_bump(1, s4, -1, limiter);
      for (int j = 0; j < 40; ++j) {
        for (int i = 0; i < 60; ++i) {
          const FlowState q = one.at(i, 39 - j);
          other.set(i, j, {q.h, q.hu, -q.hv});
        }
      }
      one.advance_to(0.5), other.advance_to(0.5);
      EXPECT_EQ(one.steps(), other.steps());
      for (int j = 0; j < 40; ++j) {
        for (int i = 0; i < 60; ++i) {
          const FlowState a = one.at(i, j), b = other.at(i, 39 - j);
          ASSERT_EQ(a.h, b.h) << i << " " << j;
          ASSERT_EQ(a.hu, b.hu) << i << " " << j;
          ASSERT_EQ(a.hv, -b.hv) << i << " " << j;
        }
      }
    }
  }
}

// A symmetric scene stays symmetric about its centre line, also where an obstacle divides it.
TEST(NocSymmetry, CentreLineIsKept) {
  SolverSettings s;
  s.grid = {60, 40, 1.0 / 64, 1.0 / 64, 0, -20.0 / 64};
  s.closure = quartz();
  s.sides = sides(Side::Kind::outflow, Side::Kind::wall);
  NocBed bed;
  bed.obstacles.push_back(
      [](double x, double y) { return std::max(0.0, std::min(0.06, 1.2 * (0.1 - std::max(std::abs(x - 0.6), std::abs(y))))); });
  NocSolver solver(s, ReferenceSurface::incline(degrees(35), 1), bed);
  solver.set([](double x, double y) {
    const double h = std::max(0.0, 0.1 - 2 * (x - 0.25) * (x - 0.25) - 2 * y * y);
    return FlowState{h, h, 0};
  });
  solver.advance_to(0.5);
  EXPECT_GT(solver.obstacle_impulse(0)[0], 0);
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 60; ++i) {
      const FlowState a = solver.at(i, j), b = solver.at(i, 39 - j);
      ASSERT_EQ(a.h, b.h);
      ASSERT_EQ(a.hu, b.hu);
      ASSERT_EQ(a.hv, -b.hv);
    }
  }
}

TEST(NocSymmetry, SameBitsForAnyNumberOfThreads) {
  NocSolver one = heap_on_bump(1), three = heap_on_bump(3);
  one.advance_to(0.5), three.advance_to(0.5);
  EXPECT_EQ(bits_of(one), bits_of(three));
  EXPECT_EQ(one.budget().friction, three.budget().friction);
  EXPECT_EQ(one.obstacle_impulse(0), three.obstacle_impulse(0));
}

}  // namespace
}  // namespace couloir::test
