// Boxes of finer cells that stay where they are.

#include <gtest/gtest.h>

#include "refined.hpp"

namespace couloir::test {
namespace {

SolverSettings three_levels(Side::Kind kind) {
  SolverSettings s = basin(48, 32, 0.02);
  s.block = 8;
  s.sides = sides(kind, kind);
  return refined(s, {0.35, 0.6, -0.1, 0.08, 2, 0});
}

TEST(StaticRefinement, AUniformFlowPassesUnchanged) {
  Solver s(three_levels(Side::Kind::periodic), ReferenceSurface::flat(0.96), {});
  s.set([](double, double) { return FlowState{0.05, 0.04, -0.02}; });
  s.advance_to(0.5);
  for (int j = 0; j < 32; ++j) {
    for (int i = 0; i < 48; ++i) {
      ASSERT_NEAR(s.at(i, j).h, 0.05, 1e-16);
      ASSERT_NEAR(s.at(i, j).hu, 0.04, 1e-15);
      ASSERT_NEAR(s.at(i, j).hv, -0.02, 1e-15);
    }
  }
}

TEST(StaticRefinement, KeepsMassAndMomentumToRoundOff) {
  Solver s(three_levels(Side::Kind::periodic), ReferenceSurface::flat(0.96), {});
  s.set([](double x, double y) {
    const double r = std::hypot(x - 0.3, y - 0.05);
    return r < 0.2 ? FlowState{0.1, 0.2, 0.05} : FlowState{0.02, 0, 0};
  });
  const double before = s.volume();
  const auto momentum = s.momentum();
  for (int n = 0; n < 10; ++n) {
    s.advance_to(0.1 * (n + 1));
    EXPECT_NEAR(s.volume(), before, 1e-13 * before);
    for (int q : {0, 1}) EXPECT_NEAR(s.momentum()[q], momentum[q], 2e-13 * std::abs(momentum[q]));
  }
  EXPECT_GE(s.min_depth(), 0);
}

TEST(StaticRefinement, TheBudgetClosesWithFrictionEarthPressureAndAWall) {
  SolverSettings set = three_levels(Side::Kind::outflow);
  set.closure = quartz();
  Solver s(set, ReferenceSurface::chute(degrees(35), 0.5, 0.2, 0.26), {{}, {{"block", 0.5, 0.58, -0.1, 0.12, 0.06}}});
  s.set([](double x, double y) {
    const double r2 = ((x - 0.2) * (x - 0.2) + y * y) / 0.03;
    const double h = r2 < 1 ? 0.1 * (1 - r2) : 0.0;
    return FlowState{h, 1.5 * h, 0.1 * h};
  });
  const double volume = s.volume();
  const auto before = s.momentum();
  s.advance_to(0.5);
  const Budget& b = s.budget();
  EXPECT_NEAR(s.volume(), volume + b.mass_boundary, 1e-14 * volume);
  EXPECT_EQ(b.mass_clipped, 0);
  const auto after = s.momentum();
  for (int q : {0, 1}) {
    const double all = b.gravity[q] + b.friction[q] + b.boundary[q] + b.obstacles[q] + b.cutoff[q];
    EXPECT_NEAR(after[q] - before[q], all, 1e-13 * std::abs(b.gravity[0]));
  }
  EXPECT_GT(s.obstacle_impulse(0)[0], 0);
}

// A short stream that ends within a cell across, drawn in as fast as it comes: no finer cell that is dry beside it or behind it
// keeps the zone from taking the last of it.
TEST(StaticRefinement, AZoneDrawsInTheLastOfAFlow) {
  for (const SideName side : all_sides) {
    const double sign = is_low(side) ? 1 : -1;
    const bool along_x = is_across_x(side);
    SolverSettings set = basin(48, 48, 0.02);
    set.block = 8;
    Solver s(refined(set, {0.36, 0.6, -0.12, 0.12, 2, 0}), ReferenceSurface::flat(0.96), {});
    s.set([&](double x, double y) {
      const double on = along_x ? x - 0.48 : y, across = along_x ? y : x - 0.48;
      const bool in = -sign * on > 0.1 && -sign * on < 0.2 && std::abs(across) < 0.05;
      const double h = in ? 0.01 : 0, m = sign * 1.5 * h;
      return along_x ? FlowState{h, m, 0} : FlowState{h, 0, m};
    });
    const double before = s.volume();
    s.cover({20, 28, 20, 28});
    while (s.time() < 0.5) {
      for (int k = 0; k < 8; ++k) {
        const int out = is_low(side) ? 19 : 28;
        const FlowState q = along_x ? s.at_side(out, 20 + k, opposite(side)) : s.at_side(20 + k, out, opposite(side));
        const double in = std::max(0.0, sign * (along_x ? q.hu : q.hv)), push = in > 0 ? in * in / q.h : 0;
        s.impose(0, side, k, along_x ? FaceFlux{sign * in, push, 0} : FaceFlux{sign * in, 0, push});
      }
      s.step(0.005);
    }
    double drawn = 0;
    for (int k = 0; k < 8; ++k) drawn += sign * s.passed(0, side, k).mass * 0.02;
    EXPECT_NEAR(s.volume() + drawn, before, 1e-14 * before);
    EXPECT_GE(s.min_depth(), 0);
    double beside = 0;  // in the cells along the face
    for (int k = 0; k < 8; ++k) {
      const int out = is_low(side) ? 19 : 28;
      beside += (along_x ? s.at(out, 20 + k) : s.at(20 + k, out)).h * 0.02 * 0.02;
    }
    EXPECT_GT(drawn, 0.5 * before);
    EXPECT_LT(beside, 1e-3 * before) << "side " << static_cast<int>(side);
  }
}

StepBed hills(const SolverSettings& s) {
  const auto hill = [](double x, double y) { return 0.02 * (1 + std::sin(9 * x) * std::cos(11 * y)); };
  StepBed bed;
  for (int j = 0; j < s.grid.ny; ++j) {
    for (int i = 0; i < s.grid.nx; ++i) bed.elevation.push_back(hill(s.grid.x(i), s.grid.y(j)));
  }
  bed.height = hill;
  return bed;
}

// Also where a body's elevation reaches into coarser cells whose centres it does not cover.
TEST(StaticRefinement, AnObstacleTakesAllOfTheBedsPush) {
  SolverSettings s = basin(30, 20, 0.05);
  s.sides = sides(Side::Kind::outflow, Side::Kind::wall);
  s.block = 4;
  StepBed bed;
  bed.obstacles.push_back({"ridge", 0.641, 1.012, -0.209, 0.209, 0});
  bed.height = [](double x, double y) { return std::max(0.0, std::min({x - 0.641, 1.012 - x, y + 0.209, 0.209 - y})) * 0.5; };
  bed.owner_at = [h = bed.height](double x, double y) { return h(x, y) > 0 ? 0 : -1; };
  for (int j = 0; j < s.grid.ny; ++j) {
    for (int i = 0; i < s.grid.nx; ++i) {
      bed.elevation.push_back(bed.height(s.grid.x(i), s.grid.y(j)));
      bed.owner.push_back(bed.owner_at(s.grid.x(i), s.grid.y(j)));
    }
  }
  for (const RefineBox& box : {RefineBox{0.5, 0.8, -0.1, 0.3, 2, 0}, {0.7, 0.9, -0.1, 0.1, 2, 0}, {0.1, 0.2, -0.1, 0.1, 3, 0}}) {
    SolverSettings own = refined(s, box);
    own.block = 8;
    Solver solver(own, ReferenceSurface::incline(degrees(20), 1.5), bed);
    solver.set([](double x, double) { return FlowState{0.05 + 0.02 * x, 0.05, 0.01}; });
    const int around = solver.add_control_box({10, 23, 2, 18});
    solver.advance_to(0.2);
    for (int q : {0, 1}) {
      EXPECT_GT(std::abs(solver.control_box_impulse(around)[q]), 1e-7);
      EXPECT_NEAR(solver.obstacle_impulse(0)[q], solver.control_box_impulse(around)[q], 1e-14) << box.levels;
    }
  }
}

TEST(StaticRefinement, ALakeStaysAtRest) {
  const SolverSettings set = three_levels(Side::Kind::wall);
  const StepBed bed = hills(set);
  Solver s(set, ReferenceSurface::flat(0.96), bed);
  // The bed of a coarser cell is the mean over its finest ones.
  s.fill_to(0.1);
  s.advance_to(2);
  EXPECT_LT(s.max_speed(), 1e-13);
}

TEST(StaticRefinement, APileAtRestKeepsItsBits) {
  SolverSettings set = three_levels(Side::Kind::wall);
  set.closure = quartz();
  Solver s(set, ReferenceSurface::incline(degrees(10), 0.96), {});
  s.set([](double x, double y) {
    const double h = 0.08 - 0.12 * std::hypot(x - 0.5, y - 0.02);
    return FlowState{std::max(h, 0.0), 0, 0};
  });
  const Bits before = bits(s);
  s.advance_to(1);
  EXPECT_EQ(bits(s), before);
  EXPECT_EQ(s.max_speed(), 0);
}

TEST(StaticRefinement, SameBitsForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    SolverSettings set = three_levels(Side::Kind::outflow);
    set.closure = quartz();
    set.threads = threads;
    Solver s(set, ReferenceSurface::incline(degrees(33), 0.96), {{}, {{"block", 0.5, 0.58, -0.1, 0.12, 0.06}}});
    s.set([](double x, double y) { return FlowState{std::max(0.0, 0.1 - 3 * (x - 0.2) * (x - 0.2) - y * y), 0, 0}; });
    s.advance_to(0.4);
    return std::pair{bits(s), s.budget().friction};
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(3));
}

// The same cells, cut into blocks of two sizes.
TEST(StaticRefinement, SameBitsForAnyBlockSize) {
  const auto run = [](int block) {
    SolverSettings set = basin(64, 64, 0.01);
    set.block = block;
    set.closure = quartz();
    set = refined(set, {0.16, 0.48, -0.16, 0.16, 1, 0});  // lines of blocks of either size
    Solver s(set, ReferenceSurface::incline(degrees(33), 0.64), {});
    s.set([](double x, double y) { return FlowState{std::max(0.0, 0.1 - 3 * (x - 0.2) * (x - 0.2) - y * y), 0, 0}; });
    s.advance_to(0.3);
    return bits(s);
  };
  EXPECT_EQ(run(8), run(16));
}

TEST(StaticRefinement, MirroredScenesGiveMirroredBits) {
  SolverSettings set = basin(48, 32, 0.02);
  set.block = 8;
  set.closure = quartz();
  const auto run = [&](double mirror) {
    const SolverSettings r = refined(set, {0.35, 0.6, mirror > 0 ? -0.1 : -0.08, mirror > 0 ? 0.08 : 0.1, 2, 0});
    Solver solver(r, ReferenceSurface::incline(degrees(33), 0.96), {});
    solver.set([&](double x, double y) {
      return FlowState{std::max(0.0, 0.1 - 3 * (x - 0.2) * (x - 0.2) - (y - mirror * 0.03125) * (y - mirror * 0.03125)), 0, 0};
    });
    solver.advance_to(0.3);
    return solver;
  };
  const Solver one = run(1), other = run(-1);
  for (int j = 0; j < 32; ++j) {
    for (int i = 0; i < 48; ++i) {
      ASSERT_NEAR(one.at(i, j).h, other.at(i, 31 - j).h, 1e-15);
      ASSERT_NEAR(one.at(i, j).hv, -other.at(i, 31 - j).hv, 1e-14);
    }
  }
}

}  // namespace
}  // namespace couloir::test
