// Nested grids: transfer, flows through patches, conservation but for the copying.

#include <gtest/gtest.h>

#include "continuum/noc/nested/nest.hpp"
#include "nested_scenes.hpp"
#include "tests/continuum/bodies.hpp"

namespace couloir::test {
namespace {

// The rim is bilinear in space and linear in time, so linear fields are passed on as they are.
TEST(NocNested, LinearFieldIsTransferredExactly) {
  SolverSettings s = basin(30, 20, 0.1);
  const auto field = [](double x, double y, double t) {
    return FlowState{1 + 0.3 * x - 0.2 * y + t, x + 2 * y - t, 3 - y + x * t};
  };
  noc::Nest base(s, ReferenceSurface::flat(3), {}, {}, {0, -1, {}}, nullptr);
  noc::Nest patch(s, ReferenceSurface::flat(3), {}, {}, {1, -1, {10, 20, 6, 14}}, &base);
  const auto at_time = [&](double t) { base.solver.set([&](double x, double y) { return field(x, y, t); }); };
  at_time(0), patch.read_start(base);
  at_time(1), patch.read_end(base);
  patch.solver.set([&](double x, double y) { return field(x, y, 0.25); });
  const Grid& g = patch.solver.grid();
  EXPECT_EQ(g.nx, 20 + 2 * noc::rim_width(Limiter::minmod));
  EXPECT_DOUBLE_EQ(g.x0 + patch.inside.i0 * g.dx, 1.0);
  for (int cell = 0; cell < g.nx * g.ny; ++cell) {  // else the test below would see what set() has put there
    if (!patch.inside.contains(cell % g.nx, cell / g.nx)) patch.solver.set(cell % g.nx, cell / g.nx, {});
  }
  patch.fill_rim(0.25);
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const FlowState is = patch.solver.at(i, j), should = field(g.x(i), g.y(j), 0.25);
      ASSERT_NEAR(is.h, should.h, 1e-14) << i << " " << j;
      ASSERT_NEAR(is.hu, should.hu, 1e-14);
      ASSERT_NEAR(is.hv, should.hv, 1e-14);
    }
  }
  for (int j = 6; j < 14; ++j) {
    for (int i = 10; i < 20; ++i)
      EXPECT_NEAR(patch.mean_over(i, j).h, field(0.1 * (i + 0.5), -1 + 0.1 * (j + 0.5), 0.25).h, 1e-14);
  }
}

// On the level in any direction, and straight down a slope with friction, where all terms are linear in time: no level sees an
// edge. (Across the slope friction turns, and levels that take other steps differ by its error in time.)
TEST(NocNested, UniformFlowPassesUnchanged) {
  for (const double zeta : {0.0, 35.0}) {
    SolverSettings s = basin(32, 24, 1.0 / 16);
    s.sides = sides(Side::Kind::periodic, Side::Kind::periodic);
    if (zeta > 0) s.closure = quartz();
    s.refinement.boxes.push_back({0.7, 1.3, -0.3, 0.2, 2, 0});
    NestedNoc solver(s, ReferenceSurface::incline(degrees(zeta), 2), {});
    ASSERT_EQ(solver.patches(), 2);
    solver.set([&](double, double) { return FlowState{0.1, 0.2, zeta > 0 ? 0.0 : 0.05}; });
    solver.advance_to(0.5);
    const FlowState first = solver.at(0, 0);
    const double gain = 9.81 * (std::sin(degrees(zeta)) - std::cos(degrees(zeta)) * s.closure.tan_delta);
    EXPECT_NEAR(first.hu, 0.2 + 0.1 * gain * 0.5, 1e-14);
    solver.for_finest(0, 2, -0.75, 0.75, [&](const FlowModel::Sample& c) {
      ASSERT_NEAR(c.q.h, 0.1, 1e-15);
      ASSERT_NEAR(c.q.hu, first.hu, 1e-14);
      ASSERT_NEAR(c.q.hv, first.hv, 1e-14);
    });
    EXPECT_NEAR(solver.copy_drift(), 0, 1e-15);
  }
}

// A patch over the whole domain has no rim, so it is the uniform fine solution: to the bit where that takes the same steps, and
// near where it takes its own, since the scheme's smearing depends on them. (With the literal switch of the earth pressure, which
// makes much of little, 5 % of the volume lie elsewhere.)
TEST(NocNested, PatchOverTheWholeDomainIsTheFineGrid) {
  SolverSettings s = basin(40, 20, 0.05);
  s.closure = {EarthPressure::hydraulic(), std::tan(degrees(28)), true};
  SolverSettings fine = s;
  fine.grid = {80, 40, 0.025, 0.025, 0, -0.5};
  s.refinement.boxes.push_back({0, 2, -0.5, 0.5, 1, 0});
  const auto heap = [](double x, double y) { return FlowState{std::max(0.0, 0.2 - (x - 0.5) * (x - 0.5) - y * y), 0, 0}; };
  const auto surface = ReferenceSurface::incline(degrees(35), 2);
  NestedNoc nested(s, surface, {}), own(s, surface, {});
  NocSolver same(fine, surface, {}), free(fine, surface, {});
  for (FlowModel* m : std::initializer_list<FlowModel*>{&nested, &own, &same, &free}) m->set(heap);
  while (nested.time() < 0.4) {
    const double before = nested.time();
    nested.step(0.6 * nested.stable_dt());  // so short that both half as long ones fit
    same.step(0.5 * (nested.time() - before));
    same.step(nested.time() - same.time());
    same.set_time(nested.time());
  }
  own.advance_to(0.4), free.advance_to(0.4);
  double apart = 0, sum = 0;
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 80; ++i) {
      const FlowState a = nested.patch_at(0, i, j), b = same.at(i, j);
      ASSERT_EQ(a.h, b.h) << i << " " << j;
      ASSERT_EQ(a.hu, b.hu);
      ASSERT_EQ(a.hv, b.hv);
      apart += std::abs(own.patch_at(0, i, j).h - free.at(i, j).h), sum += free.at(i, j).h;
    }
  }
  std::printf("apart from the fine grid with steps of its own: %.1e of the volume; %ld and %ld steps\n", apart / sum,
              2 * own.steps(), free.steps());
  EXPECT_LT(apart, 0.03 * sum);
}

TEST(NocNested, PileAcrossTheEdgeKeepsEveryBit) {
  for (const double zeta : {0.0, 15.0}) {
    SolverSettings s;
    s.grid = {80, 40, 0.02, 0.02, 0, -0.4};
    s.closure = quartz();
    s.refinement.boxes.push_back({0.7, 1.2, -0.05, 0.2, 2, 0});
    NestedNoc solver(s, ReferenceSurface::incline(degrees(zeta), 1.6), {});
    const double steepest = std::max(s.closure.earth_pressure.x_active, s.closure.earth_pressure.y_active_active);
    const double slope = 0.9 * (s.closure.tan_delta - std::tan(degrees(zeta))) / steepest;
    solver.set([&](double x, double y) { return FlowState{slope * std::max(0.0, 0.3 - std::hypot(x - 0.8, y)), 0, 0}; });
    const auto start = all_of(solver);
    for (int k = 0; k < 100; ++k) solver.step(1);
    EXPECT_EQ(all_of(solver), start) << zeta;
    EXPECT_EQ(solver.copy_drift(), 0);
  }
}

// Volume changes by what crosses the domain's sides and by what copying brings, momentum by the terms of the budget.
TEST(NocNested, LedgersCloseButForTheDriftThatIsReported) {
  for (Limiter limiter : {Limiter::minmod, Limiter::superbee, Limiter::eno}) {
    NestedNoc s = nested_heap(1, 2, 1, limiter);
    const double volume = s.volume();
    auto momentum = s.momentum();
    double left = 0, drift = 0;
    for (int k = 1; k <= 4; ++k) {
      s.advance_to(0.1 * k);
      const Budget b = s.budget();
      const auto now = s.momentum();
      for (int n : {0, 1}) {
        double sum = 0, scale = 0;
        for (const double t : {b.gravity[n], b.friction[n], b.boundary[n], b.obstacles[n], b.cutoff[n], b.copied[n]})
          sum += t, scale += std::abs(t);
        EXPECT_NEAR(now[n] - momentum[n], sum, 1e-12 * scale) << n;
      }
      momentum = now, left += b.mass_boundary, drift += b.mass_copied;
      s.reset_budget();
      EXPECT_NEAR(s.volume(), volume + left + s.copy_drift(), 1e-13 * volume);
      EXPECT_NEAR(s.copy_drift(), drift, 1e-14 * volume);
    }
    std::printf("limiter %d: drift %.2e of the volume\n", static_cast<int>(limiter), s.copy_drift() / volume);
    EXPECT_NE(s.copy_drift(), 0);
    EXPECT_LT(std::abs(s.copy_drift()), 0.03 * volume);
    EXPECT_GE(s.min_depth(), 0);
  }
}

// The cells of each grid hold the means of the finer ones, and a point is read on the finest grid that holds it.
TEST(NocNested, ParentsHoldTheCopiedSolution) {
  NestedNoc s = nested_heap(1, 2);
  s.advance_to(0.3);
  int cells = 0;
  s.for_finest(-1, 2, -1, 1, [&](const FlowModel::Sample&) { ++cells; });
  const Grid one = s.patch_grid(0), two = s.patch_grid(1);
  EXPECT_EQ(cells, 2400 + one.nx * one.ny * 3 / 4 + two.nx * two.ny * 3 / 4);
  for (int p = 0; p < s.patches(); ++p) {
    const Grid g = s.patch_grid(p), below = p == 0 ? s.grid() : one;
    for (int j = 0; j < g.ny; j += 2) {
      for (int i = 0; i < g.nx; i += 2) {
        double mean = 0;
        for (int n : {0, 1, 2, 3}) mean += 0.25 * s.patch_at(p, i + n / 2, j + n % 2).h;
        const int ci = static_cast<int>(std::lround((g.x0 - below.x0) / below.dx)) + i / 2;
        const int cj = static_cast<int>(std::lround((g.y0 - below.y0) / below.dy)) + j / 2;
        ASSERT_NEAR(p == 0 ? s.at(ci, cj).h : s.patch_at(0, ci, cj).h, mean, 1e-16) << p << ": " << i << " " << j;
      }
    }
  }
  const auto blocks = s.blocks();
  ASSERT_EQ(blocks.size(), 3u);
  EXPECT_EQ(blocks[0], (BlockPlace{0, 0, 0, 60, 40}));
  std::vector<double> h, hu, hv;
  for (int p : {0, 1}) {
    const Grid g = s.patch_grid(p);
    const BlockPlace& b = blocks[p + 1];
    EXPECT_EQ(b, (BlockPlace{p + 1, static_cast<int>(std::lround(g.x0 / g.dx)),
                             static_cast<int>(std::lround((g.y0 - s.grid().y0) / g.dy)), g.nx, g.ny}));
    s.gather_block(p + 1, h, hu, hv);
    ASSERT_EQ(h.size(), static_cast<std::size_t>(g.nx * g.ny));
    EXPECT_EQ(hu[5 * g.nx + 7], s.patch_at(p, 7, 5).hu);
  }
  const int i = two.nx / 2, j = two.ny / 2;
  EXPECT_NEAR(s.interpolated(two.x(i), two.y(j)).h, s.patch_at(1, i, j).h, 1e-14);
  EXPECT_GT(s.patch_at(1, i, j).h, 0.001);
  EXPECT_EQ(s.interpolated(s.grid().x(3), s.grid().y(4)).h, s.at(3, 4).h);
  EXPECT_NE(s.interpolated(two.x(i), two.y(j)).h, s.FlowModel::interpolated(two.x(i), two.y(j)).h);
}

TEST(NocNested, DamBreakOverPatchesStaysPositive) {
  for (Limiter limiter : {Limiter::minmod, Limiter::superbee, Limiter::eno}) {
    SolverSettings s = basin(60, 60, 0.02);
    s.cfl = 0.5;
    s.limiter = limiter;
    s.refinement.boxes = {{0.3, 0.6, -0.2, 0.1, 2, 0}, {0.9, 1.1, 0.1, 0.4, 1, 0}};
    NestedNoc solver(s, ReferenceSurface::flat(1.2), {});
    ASSERT_EQ(solver.patches(), 3);
    solver.set([](double x, double y) {
      const double h = x - 0.6 + y < 0 ? 0.1 : 0.0;
      return FlowState{h, 4 * h, 4 * h};
    });
    const double volume = solver.volume();
    solver.advance_to(0.2);
    double least = 1;
    solver.for_finest(0, 1.2, -0.6, 0.6, [&](const FlowModel::Sample& c) { least = std::min(least, c.q.h); });
    EXPECT_GE(least, 0);
    EXPECT_GE(solver.min_depth(), 0);
    EXPECT_NEAR(solver.volume(), volume + solver.copy_drift(), 1e-13 * volume);
    std::printf("limiter %d: drift %.1e of the volume\n", static_cast<int>(limiter), solver.copy_drift() / volume);
  }
}

// Seen from around, on whatever grid, the push is that on the obstacle; what crosses a line is what is beyond it, but for the
// drift.
TEST(NocNested, ControlBoxesSeeThePushAndGaugesTheFlow) {
  NestedNoc s = nested_heap(1, 2);
  const CellBox boxes[] = {{28, 43, 12, 35}, {24, 50, 4, 34}, {0, 60, 0, 40}, {8, 20, 3, 30}};
  std::vector<int> ids;
  for (const CellBox& b : boxes) ids.push_back(s.add_control_box(b));
  const int gauge = s.add_gauge(31, 0, 40), low = s.add_gauge(31, 0, 21), high = s.add_gauge(31, 21, 40);
  for (const double t : {0.15, 0.3, 0.45}) {
    s.advance_to(t);
    const auto push = s.obstacle_impulse(0);
    const double scale = s.budget().gravity[0];
    for (const int id : ids) {  // the last one is away from it
      const auto seen = s.control_box_impulse(id);
      for (int k : {0, 1}) EXPECT_NEAR(seen[k], id == ids[3] ? 0 : push[k], 1e-13 * scale) << id << " at " << t;
    }
    EXPECT_NEAR(s.gauge(gauge), s.gauge(low) + s.gauge(high), 1e-15);
    EXPECT_NEAR(-s.budget().obstacles[0], push[0], 1e-13 * scale);
  }
  EXPECT_GT(std::abs(s.obstacle_impulse(0)[0]), 1e-3 * s.budget().gravity[0]);
  double beyond = 0;
  for (int j = 0; j < 40; ++j) {
    for (int i = 31; i < 60; ++i) beyond += s.at(i, j).h / 4096;
  }
  EXPECT_NEAR(s.gauge(gauge), beyond - s.budget().mass_boundary, 0.03 * s.volume());
}

// A block runs at a cuboid: with each level the depth on it comes nearer to that of a fine grid all over.
TEST(NocNested, LevelsComeNearerToTheFineGrid) {
  const auto depth_on_top = [](int n, int levels, double* cost) {
    SolverSettings s;
    const double dx = 0.3 * unit / n;
    s.grid = {60 * n, 40 * n, dx, dx, 0, -20 * dx * n};
    s.closure = {EarthPressure::hydraulic(), std::tan(degrees(28)), true};
    if (levels > 0) s.refinement.boxes.push_back({unit, 10.5 * unit, -4 * unit, 4 * unit, levels, 0});
    NocBed bed;
    Elevation e;
    e.add(
        ElevationBody::cuboid(0, "cuboid", 8.1 * unit, 9.6 * unit, -1.8 * unit, 1.8 * unit, 1.5 * unit, 0.3 * unit, 0.3 * unit));
    bed.obstacles.push_back([e](double x, double y) { return e.at(x, y); });
    const auto surface = ReferenceSurface::incline(degrees(40), 18 * unit);
    std::unique_ptr<FlowModel> flow;
    if (levels > 0) {
      flow = std::make_unique<NestedNoc>(s, surface, bed);
    } else {
      flow = std::make_unique<NocSolver>(s, surface, bed);
    }
    flow->set([](double x, double y) {
      const bool in = x > 1.5 * unit && x < 5.1 * unit && std::abs(y) < 2.1 * unit;
      return FlowState{in ? 1.2 * unit : 0.0, 0, 0};
    });
    flow->advance_to(0.25);
    double deepest = 0;
    flow->for_finest(8.1 * unit, 9.6 * unit, -1.8 * unit, 1.8 * unit,
                     [&](const FlowModel::Sample& c) { deepest = std::max(deepest, c.q.h); });
    *cost = static_cast<double>(flow->cell_updates());
    return deepest / unit;
  };
  double cost[4];
  const double base = depth_on_top(1, 0, &cost[0]), one = depth_on_top(1, 1, &cost[1]), two = depth_on_top(1, 2, &cost[2]),
               fine = depth_on_top(4, 0, &cost[3]);
  std::printf("depth on the cuboid: base %.4f, 1 level %.4f, 2 levels %.4f, fine %.4f; updates %.2g %.2g %.2g %.2g\n", base, one,
              two, fine, cost[0], cost[1], cost[2], cost[3]);
  EXPECT_LT(std::abs(one - fine), 0.75 * std::abs(base - fine));
  EXPECT_LT(std::abs(two - fine), 0.25 * std::abs(one - fine));
}

}  // namespace
}  // namespace couloir::test
