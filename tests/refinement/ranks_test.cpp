// Several processes together give the bits of one alone. Run by mpirun; each process does both.

#include <gtest/gtest.h>

#include "refined.hpp"

namespace couloir::test {
namespace {

SolverSettings together() {
  SolverSettings s = chute();
  s.ranks = Ranks::of_program();
  return s;
}

Solver heap(const SolverSettings& s) {
  Solver solver = heap_on_chute(s);
  solver.add_gauge(50, 10, 40);
  solver.add_control_box({44, 60, 10, 38});
  return solver;
}

void expect_same(const SolverSettings& alone, const SolverSettings& together, double t) {
  ASSERT_GT(together.ranks.count(), 1) << "to be run by mpirun";
  Solver one = heap(alone), all = heap(together);
  for (Solver* s : {&one, &all}) s->advance_to(0.5 * t), s->advance_to(t);
  EXPECT_EQ(all.steps(), one.steps());
  EXPECT_EQ(all.cell_updates(), one.cell_updates());
  EXPECT_EQ(all.blocks(), one.blocks());
  EXPECT_EQ(bits(all), bits(one));
  EXPECT_EQ(all.budget().friction, one.budget().friction);
  EXPECT_EQ(all.budget().boundary, one.budget().boundary);
  EXPECT_EQ(all.obstacle_impulse(0), one.obstacle_impulse(0));
  EXPECT_EQ(all.gauge(0), one.gauge(0));
  EXPECT_EQ(all.control_box_impulse(0), one.control_box_impulse(0));
  EXPECT_EQ(all.min_depth(), one.min_depth());
  EXPECT_EQ(all.checkpoint(), one.checkpoint());
}

TEST(Ranks, UniformCells) {
  expect_same(chute(), together(), 0.4);
}

TEST(Ranks, ThreadsToo) {
  SolverSettings threaded = together();
  threaded.threads = 2;
  expect_same(chute(), threaded, 0.05);
}

TEST(Ranks, StaticBoxes) {
  const RefineBox box{0.5, 0.7, -0.1, 0.12, 2, 0};
  expect_same(refined(chute(), box), refined(together(), box), 0.4);
}

TEST(Ranks, AMeshThatFollowsTheFlow) {
  expect_same(adaptive(chute(), 2), adaptive(together(), 2), 0.2);
}

TEST(Ranks, ACheckpointOfOneContinuesOnSeveral) {
  const RefineBox box{0.5, 0.7, -0.1, 0.12, 1, 0};
  Solver one = heap(refined(chute(), box)), all = heap(refined(together(), box));
  one.advance_to(0.2);
  all.restore(one.checkpoint());
  for (Solver* s : {&one, &all}) s->advance_to(0.3);
  EXPECT_EQ(all.checkpoint(), one.checkpoint());
}

}  // namespace
}  // namespace couloir::test
