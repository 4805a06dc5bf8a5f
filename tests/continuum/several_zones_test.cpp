#include <gtest/gtest.h>

#include "continuum/flow/flux.hpp"
#include "scenes.hpp"

namespace couloir::test {
namespace {

// A heap above the middle of a slope with walls, to the same bits on both sides of it; the zones lie in its way.
Solver heap_above_zones(int threads) {
  SolverSettings s = basin(60, 40, 0.02);
  s.closure = quartz();
  s.threads = threads;
  Solver solver(s, ReferenceSurface::chute(degrees(35), 0.6, 0.3, 0.3), {});
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 60; ++i) {
      const double x = s.grid.x(i) - 0.3, y = s.grid.y(j), h = 0.12 * (1 - (x * x + y * y) / 0.06);
      const FlowState q = h > 0 ? FlowState{h, 1.5 * h, 0.2 * h * (y < -0.1 ? 1 : -1)} : FlowState{};
      solver.set(i, j, q);
      solver.set(i, 39 - j, {q.h, q.hu, -q.hv});
    }
  }
  return solver;
}

constexpr CellBox below{20, 32, 6, 18}, above{20, 32, 22, 34};

// A zone draws its upstream neighbours in, `strength` times as fast as they flow, and gives some off sideways: mirrored where it
// lies above the middle.
void drive(Solver& s, int zone, double strength) {
  const CellBox& b = s.covered(zone);
  for (int k = 0; k < b.j1 - b.j0; ++k) {
    const FlowState q = s.at(b.i0 - 1, b.j0 + k);
    const double u = q.h > 1e-9 ? q.hu / q.h : 0.0, v = q.h > 1e-9 ? q.hv / q.h : 0.0, drawn = strength * std::max(q.hu, 0.0);
    s.impose(zone, SideName::upstream, k, {drawn, drawn * u, drawn * v});
  }
  for (int k = 0; k < b.i1 - b.i0; ++k) {
    s.impose(zone, SideName::left, k, {-0.002, -0.001, 0.0004});
    s.impose(zone, SideName::right, k, {0.002, 0.001, 0.0004});
  }
}

// strengths: by zone.
void advance(Solver& s, double to, std::initializer_list<double> strengths) {
  while (s.time() < to) {
    int zone = 0;
    for (double strength : strengths) {
      if (!s.covered(zone).empty()) drive(s, zone, strength);
      ++zone;
    }
    s.step(std::min(0.01, to - s.time()));
  }
}

double passed_inwards(const Solver& s, int zone) {
  const CellBox& b = s.covered(zone);
  double sum = 0;
  for (SideName side : all_sides) {
    const int faces = is_across_x(side) ? b.j1 - b.j0 : b.i1 - b.i0;
    for (int k = 0; k < faces; ++k) {
      sum += (is_low(side) ? 1 : -1) * s.passed(zone, side, k).mass * (is_across_x(side) ? s.grid().dy : s.grid().dx);
    }
  }
  return sum;
}

TEST(SeveralZones, KeepMassAndMomentum) {
  Solver s = heap_above_zones(1);
  const int one = s.cover(below), two = s.cover(above);
  const double before = s.volume();
  const auto p0 = s.momentum();
  s.reset_budget();
  advance(s, 0.4, {0.5, 3});
  const Budget& b = s.budget();
  const double in_one = passed_inwards(s, one), in_two = passed_inwards(s, two);
  EXPECT_GT(in_one, 0.01 * before);
  EXPECT_GT(in_two, in_one);
  EXPECT_NEAR(b.mass_zone, -(in_one + in_two), 1e-13 * before);
  EXPECT_NEAR(s.volume(), before + b.mass_zone, 1e-13 * before);
  EXPECT_EQ(b.mass_clipped, 0);
  EXPECT_GE(s.min_depth(), 0);
  const auto p = s.momentum();
  for (int q : {0, 1}) {
    EXPECT_NEAR(p[q] - p0[q], b.gravity[q] + b.friction[q] + b.boundary[q] + b.zone[q] + b.cutoff[q],
                1e-13 * std::abs(b.gravity[0]));
  }
}

TEST(SeveralZones, MirroredPairGivesMirroredBits) {
  Solver s = heap_above_zones(1);
  s.cover(below), s.cover(above);
  advance(s, 0.4, {2, 2});
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 60; ++i) {
      const FlowState a = s.at(i, j), b = s.at(i, 39 - j);
      ASSERT_EQ(a.h, b.h) << i << " " << j;
      ASSERT_EQ(a.hu, b.hu) << i << " " << j;
      ASSERT_EQ(a.hv, -b.hv) << i << " " << j;
    }
  }
  for (int k = 0; k < 12; ++k) {
    EXPECT_EQ(s.passed(0, SideName::upstream, k).mass, s.passed(1, SideName::upstream, 11 - k).mass);
    EXPECT_EQ(s.passed(0, SideName::right, k).mass, -s.passed(1, SideName::left, k).mass);
  }
}

// A second zone that does nothing where there is nothing: the first and the flow do not notice.
TEST(SeveralZones, OneFarFromTheFlowChangesNoBits) {
  Solver alone = heap_above_zones(1), both = heap_above_zones(1);
  both.cover({56, 60, 0, 40});
  alone.cover(below);
  const int zone = both.cover(below);
  while (alone.time() < 0.15) {
    drive(alone, 0, 2), drive(both, zone, 2);
    alone.step(0.01), both.step(0.01);
  }
  EXPECT_EQ(bits(alone), bits(both));
  EXPECT_EQ(passed_inwards(alone, 0), passed_inwards(both, zone));
}

TEST(SeveralZones, SameBitsForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    Solver s = heap_above_zones(threads);
    s.cover(below), s.cover(above);
    advance(s, 0.3, {1, 3});
    return s.checkpoint();
  };
  EXPECT_EQ(run(1), run(3));
}

// A cell of one column between two zones that both ask for more than there is: together they get half of it in a step, each in
// proportion to what it asks for.
TEST(SeveralZones, ShareACellBetweenThem) {
  for (bool turned : {false, true}) {
    SolverSettings set = basin(24, 24, 0.05);
    Solver s(set, ReferenceSurface::flat(1.2), {});
    const auto cell = [&](int along, int across) { return turned ? s.at(across, along) : s.at(along, across); };
    s.set([&](double x, double y) {
      const int along = static_cast<int>((turned ? y + 0.6 : x) / 0.05);
      return FlowState{along == 11 ? 0.04 : 0, 0, 0};
    });
    const SideName low_rim = turned ? SideName::left : SideName::upstream,
                   high_rim = turned ? SideName::right : SideName::downstream;
    const int one = s.cover(turned ? CellBox{8, 16, 4, 11} : CellBox{4, 11, 8, 16});
    const int two = s.cover(turned ? CellBox{8, 16, 12, 20} : CellBox{12, 20, 8, 16});
    for (int k = 0; k < 8; ++k) s.impose(one, high_rim, k, {-3e3, 0, 0}), s.impose(two, low_rim, k, {1e3, 0, 0});
    const double before = s.volume();
    s.step(1e-3);
    for (int k = 0; k < 8; ++k) {
      EXPECT_NEAR(s.passed(one, high_rim, k).mass, -0.75 * 0.5 * 0.04 * 0.05, 1e-16);
      EXPECT_NEAR(s.passed(two, low_rim, k).mass, 0.25 * 0.5 * 0.04 * 0.05, 1e-16);
    }
    EXPECT_NEAR(cell(11, 12).h, 0.5 * 0.04, 1e-16);
    for (int n = 0; n < 200; ++n) s.step(1e-3);
    EXPECT_GE(s.min_depth(), 0);
    EXPECT_LT(cell(11, 12).h, 0.01 * 0.04);
    EXPECT_NEAR(s.volume() + passed_inwards(s, one) + passed_inwards(s, two), before, 1e-15 * before);
  }
}

TEST(SeveralZones, CheckpointContinuesToTheSameBits) {
  Solver whole = heap_above_zones(1);
  whole.cover({40, 44, 2, 8});
  whole.cover(below), whole.cover(above);
  advance(whole, 0.1, {0, 2, 1});
  whole.uncover(0);
  advance(whole, 0.15, {0, 2, 1});
  const auto bytes = whole.checkpoint();
  Solver again = heap_above_zones(2);
  again.cover({1, 5, 1, 5});
  again.restore(bytes);
  EXPECT_EQ(again.zones(), 3);
  EXPECT_TRUE(again.covered(0).empty());
  EXPECT_EQ(again.covered(2).j0, above.j0);
  for (Solver* s : {&whole, &again}) {
    s->reset_rim(1);
    s->advance_to(0.16);  // with what was imposed before
    s->move_zone(2, {20, 40, 24, 34});
    EXPECT_EQ(s->cover({40, 44, 2, 8}), 3);
    advance(*s, 0.3, {0, 2, 1});
  }
  EXPECT_EQ(bits(again), bits(whole));
  EXPECT_EQ(again.checkpoint(), whole.checkpoint());
}

// All cells' volume stays the same when a zone moves; what it leaves is stepped, what it takes is not.
TEST(SeveralZones, AMovedZoneKeepsWhatCellsHold) {
  Solver s = heap_above_zones(1);
  s.cover(below);
  const int zone = s.cover(above);
  advance(s, 0.1, {0, 1});
  const Bits before = bits(s);
  const auto covered_volume = [&] {
    double sum = 0;
    for (int id = 0; id < s.zones(); ++id) {
      const CellBox& b = s.covered(id);
      for (int j = b.j0; j < b.j1; ++j) {
        for (int i = b.i0; i < b.i1; ++i) sum += s.at(i, j).h * 0.02 * 0.02;
      }
    }
    return sum;
  };
  const double all = s.volume() + covered_volume(), open = s.volume();
  s.move_zone(zone, {24, 40, 20, 30});
  EXPECT_EQ(bits(s), before);
  EXPECT_NE(s.volume(), open);
  EXPECT_NEAR(s.volume() + covered_volume(), all, 1e-15 * all);
  EXPECT_EQ(s.passed(zone, SideName::upstream, 0).mass, 0);
  EXPECT_EQ(s.covered(zone).i0, 24);
  const FlowState joined = s.at(36, 28), left = s.at(21, 28);
  const double volume = s.volume();
  s.reset_budget();
  for (int n = 0; n < 5; ++n) s.step(0.002);
  EXPECT_EQ(s.at(36, 28).h, joined.h);
  EXPECT_NE(s.at(21, 28).h, left.h);
  EXPECT_NEAR(s.volume(), volume + s.budget().mass_zone, 1e-15 * volume);
  EXPECT_EQ(passed_inwards(s, zone), 0) << "nothing is imposed at the new rim";
}

std::string refusal(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "accepted";
}

TEST(SeveralZones, KeepAnOpenCellBetweenThem) {
  SolverSettings set = basin(40, 20, 0.05);
  set.sides[2].kind = set.sides[3].kind = Side::Kind::periodic;
  Solver s(set, ReferenceSurface::flat(2), {});
  s.cover({10, 20, 5, 10});
  EXPECT_EQ(refusal([&] {
              s.cover({20, 25, 5, 10});
            }),
            "A covered zone of the cells [20, 25) x [5, 10) overlaps or touches zone 0 of the cells [10, 20) x [5, 10); leave at "
            "least one open cell between them, or cover one box around both.");
  EXPECT_NE(refusal([&] { s.cover({15, 16, 7, 8}); }), "accepted");
  EXPECT_NE(refusal([&] { s.cover({20, 25, 10, 12}); }), "accepted") << "they touch round the corner";
  const int high = s.cover({10, 20, 11, 19});
  EXPECT_EQ(high, 1) << "a refused zone takes no number";
  EXPECT_NE(refusal([&] { s.move_zone(high, {10, 20, 10, 19}); }), "accepted");
  EXPECT_EQ(s.covered(high).j0, 11);
  s.move_zone(high, {10, 20, 12, 20});
  EXPECT_NE(refusal([&] { s.cover({12, 14, 0, 2}); }), "accepted") << "they touch over the periodic sides";
  s.uncover(0);
  EXPECT_EQ(s.cover({10, 20, 5, 11}), 2);
  EXPECT_EQ(refusal([&] { s.covered(3); }), "There is no covered zone 3; 3 have been covered so far, counted from 0.");
  EXPECT_EQ(refusal([&] { s.move_zone(0, {1, 2, 1, 2}); }), "The covered zone 0 has been uncovered; cover a box anew.");
  EXPECT_THROW(s.impose(0, SideName::upstream, 0, {}), std::out_of_range);
}

}  // namespace
}  // namespace couloir::test
