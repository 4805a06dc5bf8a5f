#include "coupling/transfer/fill.hpp"

#include <gtest/gtest.h>

#include "stock.hpp"

namespace couloir {
namespace {

TEST(Fill, WeighsWhatIsAskedToAGrain) {
  const PackingTable table(lattice_packing(), 2500);
  const auto surface = ReferenceSurface::incline(0.6, 1);
  const auto cap = [](double x, double y) {
    const double r2 = ((x - 0.5) * (x - 0.5) + y * y) / 0.04;
    return FlowState{r2 < 1 ? 0.04 * (1 - r2) : 0, 0, 0};
  };
  std::int64_t next = 1;
  const double asked = 2.9;
  double mass = 0;
  for (const NewGrain& g : fill({0, 1, -0.5, 0.5}, cap, asked, table, surface, next)) mass += table.grain_mass(g.radius);
  EXPECT_NEAR(mass, asked, 1.01 * table.grain_mass(0.0024));
}

TEST(Fill, GivesTheFlowsVelocityAlongTheSurface) {
  const PackingTable table(lattice_packing(), 2500);
  const auto surface = ReferenceSurface::incline(0.6, 1);
  std::int64_t next = 1;
  const auto grains = fill(
      {0.2, 0.4, -0.1, 0.1},
      [](double, double) {
        return FlowState{0.02, 0.03, 0.01};
      },
      0, table, surface, next);
  ASSERT_FALSE(grains.empty());
  for (const NewGrain& g : grains) {
    EXPECT_NEAR(g.velocity[0], 1.5, 1e-12);
    EXPECT_NEAR(g.velocity[1], 0.5, 1e-12);
    EXPECT_NEAR(g.velocity[2], 0, 1e-12);
  }
}

TEST(Fill, LeavesNoGrainInAWall) {
  const PackingTable table(lattice_packing(), 2500);
  const auto surface = ReferenceSurface::incline(0.6, 1);
  const auto layer = [](double, double) { return FlowState{0.04, 0, 0}; };
  const auto over = [&](const FillBox& box) {
    std::int64_t next = 1;
    double mass = 0;
    int out = 0;
    for (const NewGrain& g : fill(box, layer, 0.85, table, surface, next)) {
      const auto [x, y, z] = g.position;
      out += x - g.radius < box.x0 || x + g.radius > box.x1 || y - g.radius < box.y0 || y + g.radius > box.y1;
      mass += table.grain_mass(g.radius);
    }
    EXPECT_NEAR(mass, 0.85, 2.02 * table.grain_mass(0.0024)) << "to a grain in each of two tiles";
    return out;
  };
  EXPECT_GT(over({0.1, 0.3, -0.05, 0.05}), 0);
  EXPECT_EQ(over({0.1, 0.3, -0.05, 0.05, {true, true, true, true}}), 0);
}

TEST(Fill, RefusesAFlowDeeperThanThePacking) {
  const PackingTable table(lattice_packing(), 2500);
  std::int64_t next = 1;
  EXPECT_THROW(fill(
                   {0, 0.1, 0, 0.1},
                   [](double, double) {
                     return FlowState{1, 0, 0};
                   },
                   0, table, ReferenceSurface::flat(1), next),
               std::invalid_argument);
}

}  // namespace
}  // namespace couloir
