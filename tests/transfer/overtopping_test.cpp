#include "coupling/transfer/overtopping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace couloir {
namespace {

Grains at(double x, double y) {
  Grains g;
  g.id = {3};
  g.x = {x};
  g.y = {y};
  g.z = {0.09};
  g.vx = g.vy = g.vz = {0};
  g.radius = {0.002};
  g.driven = {0};
  return g;
}

TEST(Overtopping, CountsNetPassagesWithinTheWidth) {
  const auto surface = ReferenceSurface::incline(0.6, 1);
  const double m = 4.0 / 3.0 * M_PI * 8e-9 * 1100;
  Overtopping o(0.5, -0.08, 0.08, 1100);
  o.look(at(0.51, 0), surface);
  EXPECT_EQ(o.mass(), 0) << "first seen beyond: not known to have passed";
  o.look(at(0.49, 0), surface);
  EXPECT_DOUBLE_EQ(o.mass(), -m);
  o.look(at(0.52, 0.01), surface);
  EXPECT_NEAR(o.mass(), 0, 1e-20);
  o.look(at(0.48, 0.2), surface);
  EXPECT_NEAR(o.mass(), 0, 1e-20) << "beside the obstacle";
}

}  // namespace
}  // namespace couloir
