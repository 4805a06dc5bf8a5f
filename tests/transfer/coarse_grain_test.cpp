#include "coupling/transfer/coarse_grain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace couloir {
namespace {

Grains cloud(double x0, double x1, double y0, double y1) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(x0, x1), y(y0, y1), v(-1, 1);
  Grains g;
  for (int n = 0; n < 500; ++n) {
    g.id.push_back(n + 1);
    g.x.push_back(x(random));
    g.y.push_back(y(random));
    g.z.push_back(0.01);
    g.vx.push_back(v(random));
    g.vy.push_back(v(random));
    g.vz.push_back(0);
    g.radius.push_back(0.002);
    g.driven.push_back(0);
  }
  return g;
}

TEST(CoarseGrain, KeepsMassAndMomentumInsideTheBox) {
  const Grid grid{40, 20, 0.01, 0.01, 0, -0.1};
  const Grains g = cloud(0.15, 0.25, -0.04, 0.04);
  const auto field = coarse_grain(g, grid, {10, 30, 2, 18}, ReferenceSurface::incline(0.5, 0.4), 1100, 620, false);
  double h = 0, hu = 0, hv = 0, m = 0, px = 0, py = 0;
  for (const FlowState& q : field.cells) h += q.h, hu += q.hu, hv += q.hv;
  const double mass = 4.0 / 3.0 * M_PI * 8e-9 * 1100;
  for (std::size_t n = 0; n < g.size(); ++n) m += mass, px += mass * g.vx[n], py += mass * g.vy[n];
  const double per = 620 * 1e-4;
  EXPECT_NEAR(h * per, m, 1e-12 * m);
  EXPECT_NEAR(hu * per, px, 1e-12 * m);
  EXPECT_NEAR(hv * per, py, 1e-12 * m);
}

TEST(CoarseGrain, APeriodicWidthLosesNothingAtItsSeam) {
  const Grid grid{40, 10, 0.01, 0.01, 0, 0};
  const Grains g = cloud(0.15, 0.25, 0, 0.1);
  const auto field = coarse_grain(g, grid, {10, 30, 0, 10}, ReferenceSurface::flat(0.4), 1100, 620, true);
  double h = 0;
  for (const FlowState& q : field.cells) h += q.h;
  EXPECT_NEAR(h * 620 * 1e-4, 500 * 4.0 / 3.0 * M_PI * 8e-9 * 1100, 1e-12);
}

}  // namespace
}  // namespace couloir
