// Meshes that follow the flow.

#include <gtest/gtest.h>

#include "refined.hpp"

namespace couloir::test {
namespace {

TEST(AdaptiveRefinement, FollowsTheFrontAndKeepsMass) {
  Solver s = heap_on_chute(adaptive(chute(), 2));
  const double before = s.volume();
  const std::size_t first = s.blocks().size();
  EXPECT_GT(first, 72u);
  for (int n = 1; n <= 8; ++n) {
    s.advance_to(0.1 * n);
    EXPECT_NEAR(s.volume(), before + s.budget().mass_boundary, 2e-14 * before);
  }
  EXPECT_GE(s.min_depth(), 0);
  const Budget& b = s.budget();
  const auto p = s.momentum();
  for (int q : {0, 1}) {
    const double all = b.gravity[q] + b.friction[q] + b.boundary[q] + b.obstacles[q] + b.cutoff[q];
    EXPECT_NEAR(p[q], all, 1e-13 * std::abs(b.gravity[0]));
  }
}

TEST(AdaptiveRefinement, IsNearerToTheFineGridThanTheCoarseOne) {
  SolverSettings fine = adaptive(chute(), 0);
  fine.grid = fine.grid.refined(1);
  const Solver coarse = [] {
    Solver s = heap_on_chute(adaptive(chute(), 0));
    s.advance_to(0.4);
    return s;
  }();
  const Solver refined = [] {
    Solver s = heap_on_chute(adaptive(chute(), 1));
    s.advance_to(0.4);
    return s;
  }();
  const Solver exact = [&] {
    Solver s = heap_on_chute(fine);
    s.advance_to(0.4);
    return s;
  }();
  double by_coarse = 0, by_adaptive = 0;
  for (int j = 0; j < 48; ++j) {
    for (int i = 0; i < 96; ++i) {
      double h = 0;
      for (int m : {0, 1}) h += 0.25 * (exact.at(2 * i, 2 * j + m).h + exact.at(2 * i + 1, 2 * j + m).h);
      by_coarse += std::abs(coarse.at(i, j).h - h), by_adaptive += std::abs(refined.at(i, j).h - h);
    }
  }
  EXPECT_LT(by_adaptive, 0.3 * by_coarse);
}

// Two fronts, one dry, with much at rest behind and much dry ahead of them.
TEST(AdaptiveRefinement, RefinesTheFrontsOfADamBreakAlone) {
  const auto run = [](int halvings, int levels) {
    SolverSettings set = adaptive(basin(256, 16, 0.0125), levels);
    set.block = 8;
    set.grid = set.grid.refined(halvings);
    Solver s(set, ReferenceSurface::flat(3.2), {});
    s.set([&](double x, double) { return FlowState{x < set.grid.x0 + 1.6 ? 0.1 : 0.0, 0, 0}; });
    s.advance_to(0.3);
    return s;
  };
  const Solver uniform = run(1, 0), followed = run(0, 1);
  EXPECT_LT(followed.cell_updates(), 0.6 * uniform.cell_updates());
  int i = 0;
  while (followed.at(i, 8).h > 1e-3) ++i;
  for (const BlockPlace& b : followed.blocks()) {
    EXPECT_TRUE(b.level == 1 || i < b.i0 || i >= b.i0 + b.nx) << "front in cell " << i;
  }
}

// A film whose front is about to leave one side: the cells behind the other one wait for it, finest.
TEST(AdaptiveRefinement, RefinesWhereAFrontWillComeInOverAPeriodicSide) {
  const auto levels_beyond = [](Side::Kind kind, bool along) {
    SolverSettings set = adaptive(along ? basin(64, 16, 0.0125) : basin(16, 64, 0.0125), 2);
    set.block = 8;
    for (int side : {0, 1}) set.sides[along ? side : 2 + side].kind = kind;
    Solver s(set, ReferenceSurface::flat(set.grid.nx * set.grid.dx), {});
    s.set([&](double x, double y) {
      const double at = along ? x : y + 0.4;
      const double h = at > 0.4 && at < 0.79 ? 0.02 : 0.0;
      return along ? FlowState{h, h, 0} : FlowState{h, 0, h};
    });
    int most = 0;
    for (const BlockPlace& b : s.blocks()) most = std::max(most, (along ? b.i0 : b.j0) == 0 ? b.level : 0);
    return most;
  };
  for (bool along : {true, false}) {
    EXPECT_EQ(levels_beyond(Side::Kind::periodic, along), 2) << along;
    EXPECT_EQ(levels_beyond(Side::Kind::outflow, along), 0) << along;
  }
}

// The flow nears an obstacle from the far side of the domain.
TEST(AdaptiveRefinement, AnObstacleOverAPeriodicSideIsNear) {
  SolverSettings set = adaptive(basin(64, 16, 0.0125), 1);
  set.block = 8;
  set.sides[0].kind = set.sides[1].kind = Side::Kind::periodic;
  set.refinement.adaptive.front = false;
  set.refinement.adaptive.gradient = 0;
  set.refinement.adaptive.obstacle = 0.06;
  Solver s(set, ReferenceSurface::flat(0.8), {{}, {{"block", 0.025, 0.075, -0.025, 0.025, 0.05}}});
  s.set([](double x, double) { return FlowState{x > 0.7 ? 0.02 : 0.0, 0, 0}; });
  int low = 0, high = 0;
  for (const BlockPlace& b : s.blocks()) {
    if (b.i0 == 0) low = std::max(low, b.level);
    if ((b.i0 + b.nx) == 64 << b.level) high = std::max(high, b.level);
  }
  EXPECT_EQ(low, 1) << "about the obstacle";
  EXPECT_EQ(high, 1) << "its surroundings reach over the side";
}

// Two zones in the heap's way: the cells along both rims are finest, also after one has moved, and what both draw in is all that
// is missing.
TEST(AdaptiveRefinement, RefinesTheRimsOfAllCoveredZones) {
  Solver s = heap_on_chute(adaptive(chute(), 1));
  const double before = s.volume();
  s.cover({30, 40, 6, 18}), s.cover({30, 40, 28, 40});
  double covered = before - s.volume();
  const auto draw_until = [&](double end) {  // as fast as it comes
    while (s.time() < end) {
      for (int zone : {0, 1}) {
        const CellBox& box = s.covered(zone);
        for (int k = 0; k < 12; ++k) {
          const FlowState q = s.at(box.i0 - 1, box.j0 + k);
          const double u = q.h > 1e-9 ? q.hu / q.h : 0.0, in = std::max(0.0, q.hu);
          s.impose(zone, SideName::upstream, k, {in, in * u, 0});
        }
      }
      s.step(std::min(0.01, end - s.time()));
    }
  };
  const auto finest_along = [&](const CellBox& zone) {
    for (const BlockPlace& b : s.blocks()) {
      const int at = b.level, i0 = b.i0 >> at, i1 = (b.i0 + b.nx) >> at, j0 = b.j0 >> at, j1 = (b.j0 + b.ny) >> at;
      const bool meets = i0 <= zone.i1 && i1 >= zone.i0 && j0 <= zone.j1 && j1 >= zone.j0;
      const bool within = i0 > zone.i0 && i1 < zone.i1 && j0 > zone.j0 && j1 < zone.j1;
      if (meets && !within && at < 1) return false;
    }
    return true;
  };
  draw_until(0.15);
  EXPECT_TRUE(finest_along(s.covered(0)) && finest_along(s.covered(1)));
  EXPECT_LT(s.budget().mass_zone, -1e-3 * before);
  EXPECT_NEAR(s.volume(), before - covered + s.budget().mass_zone + s.budget().mass_boundary, 2e-14 * before);
  const double open = s.volume();
  s.move_zone(1, {44, 56, 28, 40});
  covered += open - s.volume();
  draw_until(0.25);
  EXPECT_TRUE(finest_along(s.covered(0)) && finest_along(s.covered(1)));
  EXPECT_NEAR(s.volume(), before - covered + s.budget().mass_zone + s.budget().mass_boundary, 2e-14 * before);
  EXPECT_GE(s.min_depth(), 0);
}

TEST(AdaptiveRefinement, CheckpointContinuesToTheSameBits) {
  Solver whole = heap_on_chute(adaptive(chute(), 2));
  whole.advance_to(0.2);
  const auto bytes = whole.checkpoint();
  whole.advance_to(0.4);
  Solver again = heap_on_chute(adaptive(chute(), 2));
  again.restore(bytes);
  again.advance_to(0.4);
  EXPECT_EQ(bits(again), bits(whole));
  EXPECT_EQ(again.blocks(), whole.blocks());
  EXPECT_EQ(again.checkpoint(), whole.checkpoint());
}

TEST(AdaptiveRefinement, SameBitsForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    SolverSettings set = adaptive(chute(), 2);
    set.threads = threads;
    Solver s = heap_on_chute(set);
    s.advance_to(0.3);
    return bits(s);
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace couloir::test
