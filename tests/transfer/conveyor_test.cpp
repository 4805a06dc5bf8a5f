#include "coupling/transfer/conveyor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "stock.hpp"

namespace couloir {
namespace {

const Grid grid{40, 10, 0.01, 0.01, 0, 0};
const auto never = [](int, const Vec&, double) { return false; };

struct Bench {
  PackingTable table{lattice_packing(), 2500};
  Rim rim{grid, {20, 40, 0, 10}, ReferenceSurface::flat(0.4), RimSettings{.diameter = 0.005}};
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
      b.conveyor.advance(s, ds, mass, depth, 1.3, never, b.next_id, out);
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
  b.conveyor.advance(0, 0.01, b.table.bulk_density() * 0.02 * 0.01 * b.face.drive.segment_width, depth, 1.3, never, b.next_id,
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
      0, 0.01, 0.3, depth, 1, [](int, const Vec&, double) { return true; }, b.next_id, out);
  EXPECT_TRUE(out.empty());
  EXPECT_DOUBLE_EQ(b.conveyor.owed(), 0.3);
}

TEST(Conveyor, AStandingRaftSendsNothing) {
  Bench b;
  std::vector<NewGrain> out;
  b.conveyor.advance(0, 0, 0, std::vector<double>(b.face.cells, 0.02), 0, never, b.next_id, out);
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
    b.conveyor.advance(0, ds, b.table.bulk_density() * 0.03 * ds * b.face.drive.segment_width, depth, 0, never, b.next_id, all);
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

}  // namespace
}  // namespace couloir
