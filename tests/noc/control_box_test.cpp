// The force on a body, seen from around it.

#include <gtest/gtest.h>

#include "noc_scenes.hpp"
#include "tests/continuum/bodies.hpp"

namespace couloir::test {
namespace {

void expect_same(std::array<double, 2> a, std::array<double, 2> b, double tolerance) {
  for (int k : {0, 1}) EXPECT_NEAR(a[k], b[k], tolerance) << k;
}

// A heap off the centre line that runs into a body on 40 deg, quartz.
NocSolver heap_before(const Elevation& body, Limiter limiter, int threads = 1, double mirror = 1) {
  SolverSettings s;
  s.grid = {120, 64, 1.0 / 256, 1.0 / 256, 0, -32.0 / 256};  // rows mirrored to the bit
  s.sides = sides(Side::Kind::outflow, Side::Kind::wall);
  s.closure = quartz();
  s.limiter = limiter;
  s.threads = threads;
  NocBed bed;
  bed.obstacles.push_back([body, mirror](double x, double y) { return body.at(x, mirror * y); });
  NocSolver solver(s, ReferenceSurface::incline(degrees(40), 12 * unit), bed);
  solver.set([&](double x, double y) {
    const double r = 1 - std::pow((x - 2 * unit) / (2 * unit), 2) - std::pow((mirror * y - 0.5 * unit) / (2.4 * unit), 2);
    const double h = r > 0 ? 1.6 * unit * std::sqrt(r) : 0.0;
    return FlowState{h, 1.2 * h, 0};
  });
  return solver;
}

CellBox around(const ElevationBody& b, const Grid& g) {
  const auto i = [&](double x) { return static_cast<int>(std::floor((x - g.x0) / g.dx)); };
  const auto j = [&](double y) { return static_cast<int>(std::floor((y - g.y0) / g.dy)); };
  return {i(b.x0()) - 2, i(b.x1()) + 3, std::max(0, j(b.y0()) - 2), std::min(g.ny, j(b.y1()) + 3)};
}

Elevation cuboid() {
  Elevation e;
  e.add(ElevationBody::cuboid(0, "cuboid", 5.5 * unit, 7 * unit, -1.5 * unit, 1.5 * unit, unit, 0.3 * unit, 0.3 * unit));
  return e;
}

TEST(NocControlBox, SeesTheBedsPush) {
  for (const Elevation& body : {cuboid(), wall_24_to_1(6 * unit), wedge(5 * unit)}) {
    for (Limiter limiter : {Limiter::minmod, Limiter::eno}) {
      NocSolver s = heap_before(body, limiter);
      const int box = s.add_control_box(around(body.bodies()[0], s.grid()));
      for (int k = 1; k <= 4; ++k) {
        s.advance_to(0.08 * k);
        const double scale = s.budget().gravity[0];
        expect_same(s.control_box_impulse(box), s.obstacle_impulse(0), 1e-13 * scale);
      }
      const auto push = s.obstacle_impulse(0), seen = s.control_box_impulse(box);
      EXPECT_GT(push[0], 0.01 * s.budget().gravity[0]);
      EXPECT_GT(std::abs(push[1]), 0.001 * push[0]);
      std::printf("push %.3e, seen from around / push - 1: %.1e\n", push[0], seen[0] / push[0] - 1);
    }
  }
}

// Weight, friction, earth pressure, an arc and a relief that is no body; the box is reached, filled and left again.
TEST(NocControlBox, TakesNothingWhereNoBodyIs) {
  for (bool relief : {false, true}) {
    SolverSettings settings;
    settings.grid = {60, 40, 0.02, 1.0 / 64, 0, -20.0 / 64};
    settings.closure = quartz();
    settings.sides = sides(Side::Kind::outflow, Side::Kind::wall);
    NocBed bed;
    if (relief) bed.ground = [](double x, double y) { return 0.01 * std::sin(9 * x + 2) * std::cos(5 * y); };
    NocSolver s(settings, ReferenceSurface::chute(degrees(40), 0.9, 0.2, 0.1), bed);
    s.set([](double x, double y) {
      const double r2 = ((x - 0.2) * (x - 0.2) + (y - 0.03) * (y - 0.03)) / 0.03;
      const double h = r2 < 1 ? 0.1 * (1 - r2) : 0.0;
      return FlowState{h, h, 0.1 * h};
    });
    const CellBox cells{23, 37, 15, 31};
    const int box = s.add_control_box(cells);
    double most = 0;
    for (int k = 1; k <= 10; ++k) {
      s.advance_to(0.1 * k);
      double inside = 0;
      for (int j = cells.j0; j < cells.j1; ++j) {
        for (int i = cells.i0; i < cells.i1; ++i) inside += s.at(i, j).hu * s.grid().dx * s.grid().dy;
      }
      most = std::max(most, inside);
      expect_same(s.control_box_impulse(box), {0, 0}, 1e-13 * s.budget().gravity[0]);
    }
    EXPECT_GT(most, 0.03 * s.budget().gravity[0]);
  }
}

// The domain's sides are faces of the box: walls, periodic sides, what flows out and what comes in.
TEST(NocControlBox, OnTheDomainsSides) {
  for (Side::Kind across : {Side::Kind::wall, Side::Kind::periodic, Side::Kind::outflow}) {
    for (Side::Kind along : {Side::Kind::outflow, Side::Kind::wall}) {
      NocSolver s = heap_on_bump(1, sides(along, across));
      const CellBox boxes[] = {{0, 60, 0, 40}, {25, 60, 0, 40}, {0, 50, 5, 40}, {20, 45, 0, 40}};
      std::vector<int> ids;
      for (const CellBox& b : boxes) ids.push_back(s.add_control_box(b));
      for (double t : {0.3, 0.6, 1.2}) {
        s.advance_to(t);
        for (int id : ids) expect_same(s.control_box_impulse(id), s.obstacle_impulse(0), 1e-13 * s.budget().gravity[0]);
      }
      EXPECT_LT(s.obstacle_impulse(0)[0], -0.01 * s.budget().gravity[0]);  // down the slope, by the lee
    }
  }
}

TEST(NocControlBox, BesideAnInflow) {
  SolverSettings settings = basin(60, 20, 0.02);
  settings.sides[0] = {Side::Kind::inflow, 0.05, 2.0};
  settings.sides[1].kind = Side::Kind::outflow;
  settings.closure = quartz();
  NocBed bed;
  bed.obstacles.push_back([](double x, double) { return std::max(0.0, 0.04 - 0.4 * std::abs(x - 0.15)); });
  NocSolver s(settings, ReferenceSurface::incline(degrees(30), 1.2), bed);
  const int box = s.add_control_box({0, 20, 0, 20}), beyond = s.add_control_box({20, 60, 0, 20});
  s.advance_to(1);
  const double scale = s.budget().gravity[0];
  expect_same(s.control_box_impulse(box), s.obstacle_impulse(0), 1e-13 * scale);
  expect_same(s.control_box_impulse(beyond), {0, 0}, 1e-13 * scale);
  EXPECT_GT(std::abs(s.obstacle_impulse(0)[0]), 1e-3 * scale);
}

// Shares limited for positivity, pairs begun anew with a shorter step, a bound on the speed: what the step does is what is seen.
TEST(NocControlBox, DamBreakAtTheBoundOfTheCflNumber) {
  SolverSettings settings = basin(60, 60, 0.02);
  settings.cfl = 0.5;
  settings.limiter = Limiter::superbee;
  NocBed bed;
  bed.obstacles.push_back(
      [](double x, double y) { return std::max(0.0, 0.08 - 0.8 * std::max(std::abs(x - 0.6), std::abs(y - 0.1))); });
  NocSolver s(settings, ReferenceSurface::flat(1.2), bed);
  s.set([](double x, double y) {
    const double h = x - 0.6 + y < 0 ? 0.1 : 0.0;
    return FlowState{h, 4 * h, 4 * h};
  });
  const int box = s.add_control_box({22, 38, 27, 43}), empty = s.add_control_box({38, 60, 3, 27});
  const double scale = s.momentum()[0];
  s.advance_to(0.4);
  EXPECT_GT(s.limited(), 0);
  expect_same(s.control_box_impulse(box), s.obstacle_impulse(0), 1e-13 * scale);
  expect_same(s.control_box_impulse(empty), {0, 0}, 1e-13 * scale);
  EXPECT_GT(std::abs(s.obstacle_impulse(0)[0]), 1e-4 * scale);
}

// Mirrored bits, and the same for any number of threads.
TEST(NocControlBox, MirroredAndByThreads) {
  const Elevation body = wedge(5 * unit);
  const CellBox cells = around(body.bodies()[0], heap_before(body, Limiter::minmod).grid());
  const auto seen = [&](int threads, double mirror, CellBox box) {
    NocSolver s = heap_before(body, Limiter::minmod, threads, mirror);
    s.add_control_box(box);
    s.advance_to(0.3);
    return s.control_box_impulse(0);
  };
  const CellBox low{cells.i0, cells.i1, cells.j0, cells.j1 - 3}, high{cells.i0, cells.i1, 64 - low.j1, 64 - low.j0};
  const auto one = seen(1, 1, low), other = seen(1, -1, high);
  EXPECT_NE(one[1], 0);
  EXPECT_EQ(one[0], other[0]);
  EXPECT_EQ(one[1], -other[1]);
  EXPECT_EQ(seen(3, 1, low), one);
}

TEST(NocControlBox, IsKeptInTheCheckpointAndMustFit) {
  NocSolver a = heap_on_bump(1);
  a.add_control_box({25, 47, 8, 36});
  a.advance_to(0.25);
  const auto bytes = a.checkpoint();
  NocSolver b = heap_on_bump(1);
  b.restore(bytes);
  EXPECT_EQ(a.control_box_impulse(0), b.control_box_impulse(0));
  a.advance_to(0.6), b.advance_to(0.6);
  EXPECT_EQ(a.control_box_impulse(0), b.control_box_impulse(0));
  EXPECT_NE(a.control_box_impulse(0)[0], 0);
  EXPECT_EQ(a.checkpoint(), b.checkpoint());
  NocSolver plain = heap_on_bump(1);
  plain.advance_to(0.25), plain.advance_to(0.6);
  EXPECT_EQ(bits_of(a), bits_of(plain)) << "a box changed the flow";
  for (const CellBox& bad : {CellBox{3, 3, 0, 4}, CellBox{-1, 3, 0, 4}, CellBox{0, 61, 0, 4}, CellBox{0, 3, 0, 41}}) {
    EXPECT_THROW(a.add_control_box(bad), std::out_of_range);
  }
}

}  // namespace
}  // namespace couloir::test
