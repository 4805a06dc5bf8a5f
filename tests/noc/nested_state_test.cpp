// Nested grids: bits, checkpoints, sides of the domain, errors.

#include <gtest/gtest.h>

#include "nested_scenes.hpp"

namespace couloir::test {
namespace {

TEST(NocNested, CheckpointContinuesToTheSameBits) {
  NestedNoc whole = nested_heap(1, 2);
  whole.add_gauge(30, 0, 40), whole.add_control_box({25, 47, 8, 36});
  whole.advance_to(0.1);
  whole.reset_budget();
  whole.advance_to(0.15);
  const auto bytes = whole.checkpoint();
  whole.advance_to(0.25);
  NestedNoc again = nested_heap(2, 2);
  again.advance_to(0.05);
  again.restore(bytes);
  EXPECT_EQ(again.time(), 0.15);
  again.advance_to(0.25);
  EXPECT_EQ(all_of(again), all_of(whole));
  EXPECT_EQ(again.checkpoint(), whole.checkpoint());
  EXPECT_EQ(again.gauge(0), whole.gauge(0));
  EXPECT_EQ(again.copy_drift(), whole.copy_drift());
  EXPECT_EQ(again.control_box_impulse(0), whole.control_box_impulse(0));
  EXPECT_THROW(nested_heap(1, 1).restore(bytes), std::invalid_argument);
}

TEST(NocNested, MirroredSceneGivesMirroredBits) {
  for (Side::Kind across : {Side::Kind::wall, Side::Kind::periodic, Side::Kind::outflow}) {
    const auto s4 = sides(Side::Kind::outflow, across);
    NestedNoc one = nested_heap(1, 2, 1, Limiter::minmod, s4), other = nested_heap(3, 2, -1, Limiter::minmod, s4);
    one.advance_to(0.2), other.advance_to(0.2);
    EXPECT_EQ(one.steps(), other.steps());
    ASSERT_EQ(one.patches(), 2);
    EXPECT_EQ(one.copy_drift(), other.copy_drift());
    EXPECT_EQ(one.obstacle_impulse(0)[0], other.obstacle_impulse(0)[0]);
    EXPECT_EQ(one.obstacle_impulse(0)[1], -other.obstacle_impulse(0)[1]);
    for (int p = 0; p < 2; ++p) {
      const Grid g = one.patch_grid(p);
      for (int j = 0; j < g.ny; ++j) {
        for (int i = 0; i < g.nx; ++i) {
          const FlowState a = one.patch_at(p, i, j), b = other.patch_at(p, i, g.ny - 1 - j);
          ASSERT_EQ(a.h, b.h) << i << " " << j;
          ASSERT_EQ(a.hu, b.hu);
          ASSERT_EQ(a.hv, -b.hv);
        }
      }
    }
    for (int j = 0; j < 40; ++j) {
      for (int i = 0; i < 60; ++i) ASSERT_EQ(one.at(i, j).hv, -other.at(i, 39 - j).hv);
    }
  }
}

// Sides of the domain run through patches, with an inflow among them.
TEST(NocNested, PatchesOnTheDomainsSides) {
  SolverSettings s = basin(60, 20, 0.02);
  s.sides[0] = {Side::Kind::inflow, 0.05, 2.0};
  s.sides[1].kind = Side::Kind::outflow;
  s.refinement.boxes = {{0, 0.2, -0.2, 0.2, 1, 0}, {1.1, 1.2, -0.2, 0.0, 1, 0}};
  NestedNoc solver(s, ReferenceSurface::flat(1.2), {});
  solver.advance_to(0.3);
  EXPECT_NEAR(solver.volume(), solver.budget().mass_boundary + solver.copy_drift(), 1e-13 * solver.volume());
  EXPECT_NEAR(solver.budget().mass_inflow, 0.05 * 2 * 0.3 * 0.4, 1e-12);
  solver.advance_to(3);
  solver.for_finest(0, 1.2, -0.2, 0.2, [](const FlowModel::Sample& c) {
    ASSERT_NEAR(c.q.h, 0.05, 1e-7) << c.x << " " << c.y;
    ASSERT_NEAR(c.q.hu, 0.1, 1e-7);
  });
}

TEST(NocNested, WrongBoxesAreRefused) {
  const auto build = [](const RefineBox& box) {
    SolverSettings s = basin(20, 20, 0.1);
    s.refinement.boxes.push_back(box);
    NestedNoc(s, ReferenceSurface::flat(2), {});
  };
  EXPECT_THROW(build({1, 1, 0, 0.5, 1, 0}), std::invalid_argument);
  EXPECT_THROW(build({2.5, 3, 0, 0.5, 1, 0}), std::invalid_argument);
  EXPECT_THROW(build({0.5, 1, 0, 0.5, 0, 0}), std::invalid_argument);
  EXPECT_THROW(build({0.5, 1, 0, 0.5, 1, -1}), std::invalid_argument);
  SolverSettings adaptive = basin(20, 20, 0.1);
  adaptive.refinement.adaptive.levels = 1;
  EXPECT_THROW(NestedNoc(adaptive, ReferenceSurface::flat(2), {}), std::invalid_argument);
  SolverSettings one = basin(20, 20, 0.1);
  one.refinement.boxes.push_back({0.5, 1, 0, 0.5, 1, 0});
  EXPECT_THROW(NocSolver(one, ReferenceSurface::flat(2), {}), std::invalid_argument);
}

}  // namespace
}  // namespace couloir::test
