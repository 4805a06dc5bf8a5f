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

TEST(Conveyor, LedgerClosesToRoundOffAndDoesNotDrift) {
  Bench b;
  double given = 0, taken = 0, worst = 0;
  const double ds = 0.0013;
  for (int window = 0; window < 2000; ++window) {
    const double h = 0.02 + 0.01 * std::sin(0.01 * window);
    std::vector<double> depth(b.face.cells, h);
    std::vector<NewGrain> out;
    for (int s = 0; s < b.face.segments; ++s) {
      const int first = s * b.face.cells_per_segment, cells = std::min(b.face.cells, first + b.face.cells_per_segment) - first;
      const double mass = b.table.bulk_density() * h * ds * cells * b.face.cell_width;
      given += mass;
      b.conveyor.advance(s, {ds, mass, 1.3}, depth, never, b.next_id, out);
    }
    for (const NewGrain& g : out) taken += b.table.grain_mass(g.radius);
    EXPECT_NEAR(given, taken + b.conveyor.owed(), 1e-12 * given);
    worst = std::max(worst, std::abs(b.conveyor.owed()));
  }
  EXPECT_NEAR(taken / given, 1, 2e-3);
  EXPECT_LT(worst, 20 * b.face.segments * b.table.mean_mass());
}

TEST(Conveyor, GrainsEnterBehindTheLayerWithTheRaftsVelocity) {
  Bench b;
  std::vector<NewGrain> out;
  std::vector<double> depth(b.face.cells, 0.02);
  b.conveyor.advance(0, {0.01, b.table.bulk_density() * 0.02 * 0.01 * b.face.drive.segment_width, 1.3}, depth, never, b.next_id,
                     out);
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

TEST(Conveyor, ARejectedGrainStaysOwed) {
  Bench b;
  std::vector<NewGrain> out;
  std::vector<double> depth(b.face.cells, 0.02);
  b.conveyor.advance(
      0, {0.01, 0.3, 1}, depth, [](int, const Vec&, double) { return true; }, b.next_id, out);
  EXPECT_TRUE(out.empty());
  EXPECT_DOUBLE_EQ(b.conveyor.owed(), 0.3);
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
    b.conveyor.advance(0, {ds, b.table.bulk_density() * 0.03 * ds * b.face.drive.segment_width}, depth, never, b.next_id, all);
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
    for (int window = 0; window < 400; ++window)
      for (int s = 0; s < face.segments; ++s) {
        const int first = s * face.cells_per_segment, cells = std::min(face.cells, first + face.cells_per_segment) - first;
        conveyor.advance(s, {ds, table.bulk_density() * h * ds * cells * face.cell_width, 1}, std::vector<double>(face.cells, h),
                         never, next_id, out);
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
    for (int w = 0; w < windows; ++w) {
      conveyor.slide(da);
      const std::size_t before = all.size();
      for (int s = 0; s < face.segments; ++s) {
        const auto [low, high] = face.reach_of_segment(s);
        const double mass = table.bulk_density() * h * ds * (high - low);
        given += mass;
        by_end += conveyor.advance(s, {ds, mass, 0.6, 0.9 * direction, s == first}, depth, never, next_id, all);
      }
      for (std::size_t n = before; n < all.size(); ++n) {
        EXPECT_EQ(all[n].velocity[1], 0.9 * direction);
        const double along = face.along(all[n].position), distance = face.distance(all[n].position);
        EXPECT_TRUE(along >= 0 && along < face.extent() && distance >= -rim.layer() - 1e-12 && distance < 0);
      }
      born.resize(all.size(), w);
    }
    for (const NewGrain& g : all) taken += table.grain_mass(g.radius);
    EXPECT_NEAR(given + by_end, taken + conveyor.owed(), 1e-12 * given);
    EXPECT_NEAR(by_end / (table.bulk_density() * h * std::abs(da) * windows * (rim.layer() - ds)), 1, 0.03);
    EXPECT_NEAR((taken - by_end) / given, 1, 0.01);
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
