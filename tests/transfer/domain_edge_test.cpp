#include "coupling/transfer/domain_edge.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace couloir {
namespace {

TEST(DomainEdge, TakesGrainsOnlyThroughOpenSides) {
  const auto surface = ReferenceSurface::flat(1);
  Grains g;
  g.id = {1, 2, 3, 4};
  g.x = {-0.01, 1.01, 0.5, 0.5};
  g.y = {0, 0, -0.3, 0.3};
  g.z = {0, 0, 0, 0};
  g.vx = {-1, 2, 0, 0};
  g.vy = g.vz = {0, 0, 0, 0};
  g.radius = {0.002, 0.002, 0.002, 0.002};
  g.driven = {0, 0, 0, 0};
  DomainEdge edge({false, true, false, true}, 1, 0.5, 1100);
  std::vector<std::int64_t> remove;
  edge.take(g, surface, remove);
  EXPECT_EQ(remove, (std::vector<std::int64_t>{2, 4}));
  const double m = 4.0 / 3.0 * M_PI * 8e-9 * 1100;
  EXPECT_DOUBLE_EQ(edge.mass(), 2 * m);
  EXPECT_DOUBLE_EQ(edge.momentum(), 2 * m);
  remove.clear();
  edge.take(g, surface, remove, [](std::int64_t id) { return id != 4; });
  EXPECT_EQ(remove, (std::vector<std::int64_t>{2, 4})) << "what is not the run's goes as well";
  EXPECT_DOUBLE_EQ(edge.mass(), 3 * m) << "but is not booked";
}

}  // namespace
}  // namespace couloir
