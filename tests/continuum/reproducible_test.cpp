#include <gtest/gtest.h>

#include "scenes.hpp"

namespace couloir::test {
namespace {

TEST(Reproducible, SameBitsForAnyNumberOfThreads) {
  Solver one = heap_on_block(1), two = heap_on_block(2), three = heap_on_block(3);
  for (Solver* s : {&one, &two, &three}) s->advance_to(0.5);
  EXPECT_EQ(bits(one), bits(two));
  EXPECT_EQ(bits(one), bits(three));
  EXPECT_EQ(one.budget().friction, two.budget().friction);
  EXPECT_EQ(one.obstacle_impulse(0), two.obstacle_impulse(0));
}

TEST(Reproducible, SameBitsForAnyBlockSize) {
  const auto run = [](int block) {
    SolverSettings s = basin(45, 33, 0.02);
    s.closure = quartz();
    s.block = block;
    Solver solver(s, ReferenceSurface::incline(degrees(33), 0.9), {{}, {{"block", 0.5, 0.62, -0.1, 0.15, 0.05}}});
    solver.set([](double x, double y) { return FlowState{std::max(0.0, 0.1 - 2 * (x - 0.2) * (x - 0.2) - y * y), 0, 0}; });
    solver.advance_to(0.5);
    return bits(solver);
  };
  const Bits whole = run(64);
  EXPECT_EQ(run(8), whole);
  EXPECT_EQ(run(11), whole);
}

TEST(Reproducible, MirroredSceneGivesMirroredBits) {
  Solver one = heap_on_block(1), other = heap_on_block(1, -1);
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 60; ++i) {
      const FlowState q = one.at(i, 39 - j);  // the bits: the cell centres' y are not mirrored to the last one
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

TEST(Reproducible, CheckpointContinuesToTheSameBits) {
  Solver whole = heap_on_block(1);
  whole.add_gauge(30, 0, 40);
  whole.advance_to(0.2);
  whole.cover({40, 50, 5, 20});
  whole.impose(0, SideName::upstream, 2, {0.001, 0.002, 0});
  whole.advance_to(0.25);
  const auto bytes = whole.checkpoint();
  whole.advance_to(0.5);
  Solver again = heap_on_block(2);
  again.restore(bytes);
  EXPECT_EQ(again.time(), 0.25);
  again.advance_to(0.5);
  EXPECT_EQ(bits(again), bits(whole));
  EXPECT_EQ(again.checkpoint(), whole.checkpoint());
  EXPECT_EQ(again.gauge(0), whole.gauge(0));
  EXPECT_EQ(again.steps(), whole.steps());
}

TEST(Reproducible, CheckpointOfAnotherSceneIsRefused) {
  Solver small(basin(8, 8, 0.1), ReferenceSurface::flat(1), {});
  auto bytes = small.checkpoint();
  EXPECT_THROW(heap_on_block(1).restore(bytes), std::invalid_argument);
  bytes.pop_back();
  EXPECT_THROW(small.restore(bytes), std::invalid_argument);
}

// Blocks without material are not stepped.
TEST(Reproducible, DryBlocksCostNothing) {
  SolverSettings s = basin(320, 320, 0.01);
  Solver solver(s, ReferenceSurface::flat(3.2), {});
  solver.set(5, 5, {0.1, 0, 0});
  solver.step(1);
  EXPECT_LE(solver.cell_updates(), 2 * 4 * 16 * 16);
}

}  // namespace
}  // namespace couloir::test
