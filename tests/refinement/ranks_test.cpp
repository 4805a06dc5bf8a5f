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

// As where there is more than MPI can count.
TEST(Ranks, TellInPiecesWhatTheyTellAtOnce) {
  const Ranks ranks = Ranks::of_program();
  const int mine = ranks.mine(), n = ranks.count();
  std::vector<std::uint8_t> own;
  for (int k = 0; k < 23 * mine; ++k) own.push_back(static_cast<std::uint8_t>(31 * k + mine));  // the first has none
  const std::vector<std::uint8_t> all = ranks.gather(own);
  EXPECT_EQ(all.size(), 23u * n * (n - 1) / 2);
  EXPECT_EQ(ranks.gather(own, 7), all);
  std::vector<std::vector<double>> out(n), in(n);
  for (int r = 0; r < n; ++r) {
    if (r == mine) continue;
    for (int k = 0; k < 10 + r; ++k) out[r].push_back(100 * mine + k);
    in[r].resize(10 + mine);
  }
  ranks.exchange(out, in, 3);
  for (int r = 0; r < n; ++r) {
    for (std::size_t k = 0; k < in[r].size(); ++k) EXPECT_EQ(in[r][k], 100 * r + double(k));
  }
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
