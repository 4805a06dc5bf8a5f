#include "coupling/transfer/conveyor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stock.hpp"

namespace couloir {
namespace {

const Grid grid{40, 10, 0.01, 0.01, 0, 0};
const auto never = [](int, const Vec&, double) { return false; };

struct Bench {
  PackingTable table{lattice_packing(), 2500};
  ReferenceSurface surface = ReferenceSurface::flat(0.4);  // the rim keeps it
  Rim rim{grid, {20, 40, 0, 10}, surface, RimSettings{.diameter = 0.005}};
  const RimFace& face = rim.faces()[0];
  Conveyor conveyor{face, 0, table, rim.layer()};
  std::int64_t next_id = 1;
};

// What the flow gives and holds before a face comes as grains, whatever its depth does meanwhile.
TEST(Conveyor, BringsWhatTheFlowGivesAndDoesNotDrift) {
  Bench b;
  double given = 0, taken = 0, worst = 0, copies = 0;
  const double ds = 0.0013;
  std::vector<double> brought(b.face.segments), wanted(b.face.segments);
  for (int window = 0; window < 2000; ++window) {
    const double h = 0.02 + 0.01 * std::sin(0.01 * window);
    std::vector<double> depth(b.face.cells, h);
    std::vector<NewGrain> out;
    copies = 0;
    for (int s = 0; s < b.face.segments; ++s) {
      const auto [low, high] = b.face.reach_of_segment(s);
      const double mass = b.table.bulk_density() * h * ds * (high - low);
      given += mass;
      wanted[s] += mass;
      const double copy = b.table.bulk_density() * h * b.conveyor.filled(s) * (high - low);
      copies += copy;
      b.conveyor.advance(s, {ds, mass, wanted[s] + copy - brought[s], 1.3}, depth, never, b.next_id, out);
      for (const NewGrain& g : out)
        if (g.segment == s) brought[s] += b.table.grain_mass(g.radius);
      worst = std::max(worst, std::abs(wanted[s] + copy - brought[s]));
    }
    for (const NewGrain& g : out) taken += b.table.grain_mass(g.radius);
  }
  EXPECT_NEAR((taken - copies) / given, 1, 1e-3);
  EXPECT_LT(worst, 60 * b.table.mean_mass()) << "the copy is renewed over the layer's depth";
}

// The flow's front passes the face in both models at once: its first grains stand at the face, and the layer grows behind them.
TEST(Conveyor, AFrontComesToTheFaceAtOnce) {
  Bench b;
  const double h = 0.02, ds = 0.001;
  const std::vector<double> depth(b.face.cells, h);
  const auto [low, high] = b.face.reach_of_segment(0);
  double moved = 0, brought = 0, nearest = -1, passed = 0;
  std::vector<NewGrain> all;
  std::vector<double> born;
  for (int window = 0; window < 40; ++window) {
    moved += ds;
    const double mass = b.table.bulk_density() * h * ds * (high - low);
    const double copy = b.table.bulk_density() * h * std::min(moved, b.rim.layer()) * (high - low);
    const std::size_t before = all.size();
    b.conveyor.advance(0, {ds, mass, (window + 1) * mass + copy - brought, 1}, depth, never, b.next_id, all);
    for (std::size_t n = before; n < all.size(); ++n) {
      brought += b.table.grain_mass(all[n].radius);
      born.push_back(moved);
      EXPECT_GE(b.face.distance(all[n].position), -std::min(moved, b.rim.layer()) - 1e-12);
      if (window < 3) nearest = std::max(nearest, b.face.distance(all[n].position));
    }
  }
  EXPECT_GT(nearest, -2 * ds);
  for (std::size_t n = 0; n < all.size(); ++n)
    if (b.face.distance(all[n].position) + moved - born[n] >= 0) passed += b.table.grain_mass(all[n].radius);
  EXPECT_NEAR(passed / (40 * b.table.bulk_density() * h * ds * (high - low)), 1, 0.05) << "no delay by the layer's depth";
  b.conveyor.empty(0);
  all.clear();
  b.conveyor.advance(0, {ds, 1, 1, 1}, depth, never, b.next_id, all);
  for (const NewGrain& g : all) EXPECT_GE(b.face.distance(g.position), -ds - 1e-12) << "a next front, too";
}

TEST(Conveyor, GrainsEnterBehindTheLayerWithTheRaftsVelocity) {
  Bench b;
  std::vector<NewGrain> out;
  std::vector<double> depth(b.face.cells, 0.02);
  const double mass = b.table.bulk_density() * 0.02 * 0.01 * b.face.drive.segment_width;
  b.conveyor.fill_up(0);
  b.conveyor.advance(0, {0.01, mass, mass, 1.3}, depth, never, b.next_id, out);
  ASSERT_FALSE(out.empty());
  for (const NewGrain& g : out) {
    const double s = b.face.distance(g.position);
    EXPECT_GE(s, -b.rim.layer() - 1e-12);
    EXPECT_LE(s, -b.rim.layer() + 0.01 + 1e-12);
    EXPECT_EQ(g.velocity[0], 1.3);
    EXPECT_EQ(g.velocity[1], 0);
    EXPECT_EQ(g.segment, 0);
    EXPECT_GE(g.position[2], g.radius) << "no overlap with the bed";
  }
}

TEST(Conveyor, ARejectedGrainDoesNotComeIn) {
  Bench b;
  std::vector<NewGrain> out;
  std::vector<double> depth(b.face.cells, 0.02);
  b.conveyor.advance(
      0, {0.01, 0.3, 0.3, 1}, depth, [](int, const Vec&, double) { return true; }, b.next_id, out);
  EXPECT_TRUE(out.empty());
}

TEST(Conveyor, AStandingRaftSendsNothing) {
  Bench b;
  std::vector<NewGrain> out;
  b.conveyor.advance(0, {}, std::vector<double>(b.face.cells, 0.02), never, b.next_id, out);
  EXPECT_TRUE(out.empty());
}

TEST(Conveyor, SuccessiveGrainsKeepTheBlocksDistances) {
  Bench b;
  std::vector<NewGrain> all;
  std::vector<double> depth(b.face.cells, 0.03), shift;
  const double ds = 0.001;
  double s = 0;
  for (int w = 0; w < 120; ++w) {
    const std::size_t before = all.size();
    s += ds;
    const double mass = b.table.bulk_density() * 0.03 * ds * b.face.drive.segment_width;
    b.conveyor.advance(0, {ds, mass, mass}, depth, never, b.next_id, all);
    for (std::size_t n = before; n < all.size(); ++n) shift.push_back(s);
  }
  // Brought to one instant, no two grains overlap.
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t c = a + 1; c < all.size(); ++c) {
      const double dx = (all[a].position[0] - shift[a]) - (all[c].position[0] - shift[c]);
      const double dy = all[a].position[1] - all[c].position[1], dz = all[a].position[2] - all[c].position[2];
      EXPECT_GT(std::sqrt(dx * dx + dy * dy + dz * dz), 0.99 * (all[a].radius + all[c].radius));
    }
}

// A grain that came in with a wall in it would be shot away; all the flow's mass comes in all the same.
TEST(Conveyor, NoGrainComesInWithAWallInIt) {
  Packing packing = lattice_packing();
  for (auto& g : packing.grains) g.y = std::fmod(g.y + 0.0025, packing.width);  // rows on both sides of the domain
  const PackingTable table{packing, 2500};
  const auto surface = ReferenceSurface::flat(0.4);
  const Rim walled(grid, {20, 40, 0, 10}, surface, {.diameter = 0.005, .walls = {false, false, true, true}});
  const RimFace& face = walled.faces()[0];
  const double width = face.cells * face.cell_width, h = 0.03, ds = 0.0013;
  const auto reaches_over = [&](const std::vector<NewGrain>& grains) {
    return std::count_if(grains.begin(), grains.end(), [&](const NewGrain& g) {
      const double along = face.along(g.position);
      return along < g.radius || along > width - g.radius;
    });
  };
  const auto send = [&](const RimFace& of) {
    Conveyor conveyor(of, 0, table, walled.layer());
    std::int64_t next_id = 1;
    std::vector<NewGrain> out;
    std::vector<double> brought(face.segments);
    for (int s = 0; s < face.segments; ++s) conveyor.fill_up(s);
    for (int window = 0; window < 400; ++window)
      for (int s = 0; s < face.segments; ++s) {
        const auto [low, high] = face.reach_of_segment(s);
        const double mass = table.bulk_density() * h * ds * (high - low);
        const std::size_t before = out.size();
        conveyor.advance(s, {ds, mass, (window + 1) * mass - brought[s], 1}, std::vector<double>(face.cells, h), never, next_id,
                         out);
        for (std::size_t n = before; n < out.size(); ++n) brought[s] += table.grain_mass(out[n].radius);
      }
    return out;
  };
  RimFace open = face;
  open.walls = {};
  EXPECT_GT(reaches_over(send(open)), 0) << "without walls grains stand across the domain's sides";
  const std::vector<NewGrain> out = send(face);
  EXPECT_EQ(reaches_over(out), 0);
  double taken = 0;
  for (const NewGrain& g : out) taken += table.grain_mass(g.radius);
  EXPECT_NEAR(taken / (table.bulk_density() * h * ds * 400 * width), 1, 0.01);
}

// The layer of an oblique flow is one body: what comes by the plane and what by the end fit together, and each brings its share.
TEST(Conveyor, ALayerThatSlidesIsFilledThroughItsEndToo) {
  const PackingTable table{lattice_packing(), 2500};
  const auto surface = ReferenceSurface::flat(0.4);
  const Rim rim(grid, {20, 40, 2, 8}, surface, {.diameter = 0.005});
  const RimFace& face = rim.faces()[0];
  ASSERT_TRUE(face.slides);
  for (const double direction : {1.0, -1.0}) {
    Conveyor conveyor(face, 0, table, rim.layer());
    const double h = 0.03, ds = 0.0006, da = direction * 0.0009;
    const std::vector<double> depth(face.cells, h);
    const int first = direction > 0 ? 0 : face.segments - 1;
    std::int64_t next_id = 1;
    std::vector<NewGrain> all;
    std::vector<int> born;
    double given = 0, by_end = 0, taken = 0;
    const int windows = 200;
    for (int s = 0; s < face.segments; ++s) conveyor.fill_up(s);
    for (int w = 0; w < windows; ++w) {
      conveyor.slide(da);
      const std::size_t before = all.size();
      for (int s = 0; s < face.segments; ++s) {
        const auto [low, high] = face.reach_of_segment(s);
        const double mass = table.bulk_density() * h * ds * (high - low);
        given += mass;
        conveyor.advance(s, {ds, mass, mass, 0.6, 0.9 * direction, s == first}, depth, never, next_id, all);
      }
      for (std::size_t n = before; n < all.size(); ++n) {
        EXPECT_EQ(all[n].velocity[1], 0.9 * direction);
        const double along = face.along(all[n].position), distance = face.distance(all[n].position);
        EXPECT_TRUE(along >= 0 && along < face.extent() && distance >= -rim.layer() - 1e-12 && distance < 0);
        (distance > -rim.layer() + ds ? by_end : taken) += table.grain_mass(all[n].radius);
      }
      born.resize(all.size(), w);
    }
    EXPECT_NEAR(by_end / (table.bulk_density() * h * std::abs(da) * windows * (rim.layer() - ds)), 1, 0.03);
    EXPECT_NEAR(taken / given, 1, 0.02);
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = a + 1; b < all.size(); ++b) {
        const double later = born[b] - born[a];
        const double dx = all[a].position[0] + later * ds - all[b].position[0];
        const double dy = all[a].position[1] + later * da - all[b].position[1], dz = all[a].position[2] - all[b].position[2];
        ASSERT_GT(std::sqrt(dx * dx + dy * dy + dz * dz), 0.98 * (all[a].radius + all[b].radius));
      }
  }
}

}  // namespace
}  // namespace couloir
