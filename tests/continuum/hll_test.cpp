#include "continuum/scheme/hll.hpp"

#include <gtest/gtest.h>

namespace couloir::test {
namespace {

TEST(Hll, OfEqualSidesIsThePhysicalFlux) {
  const NormalFlux n = hll(0.3, 0.7, 8.0, 0.3, 0.7, 8.0);
  const FaceFlux f = flux_x(0.3, 0.7, 0, 8.0);
  EXPECT_NEAR(n.mass, f.mass, 1e-16);
  EXPECT_NEAR(n.momentum, f.mom_x, 1e-15);
}

TEST(Hll, OfSupercriticalFlowTakesTheUpstreamSide) {
  const NormalFlux n = hll(0.1, 5, 9.81, 0.2, 4, 9.81);
  EXPECT_NEAR(n.mass, 0.5, 1e-15);
  EXPECT_NEAR(n.momentum, 2.5 + pressure(0.1, 9.81), 1e-14);
}

TEST(Hll, HasTheSameBitsMirrored) {
  const NormalFlux a = hll(0.3, 0.7, 8.0, 0.05, -0.2, 20.0), b = hll(0.05, 0.2, 20.0, 0.3, -0.7, 8.0);
  EXPECT_EQ(a.mass, -b.mass);
  EXPECT_EQ(a.momentum, b.momentum);
}

TEST(Hll, OfDrySidesIsNothing) {
  const NormalFlux n = hll(0, 0, 9.81, 0, 0, 9.81);
  EXPECT_EQ(n.mass, 0);
  EXPECT_EQ(n.momentum, 0);
  EXPECT_GT(hll(0.1, 0, 9.81, 0, 0, 9.81).mass, 0);
}

TEST(WallFlux, IsTheMirroredStatesAndNeverPulls) {
  for (double u : {0.0, 0.3, 2.0}) EXPECT_NEAR(wall_flux(0.2, u, 9.81), hll(0.2, u, 9.81, 0.2, -u, 9.81).momentum, 1e-14);
  EXPECT_DOUBLE_EQ(wall_flux(0.2, 0, 9.81), 0.5 * 9.81 * 0.04);
  EXPECT_EQ(wall_flux(0.2, -5, 9.81), 0);
  double last = 0;
  for (double h = 0; h < 1; h += 0.01) {
    EXPECT_GE(wall_flux(h, -0.4, 9.81), last);
    last = wall_flux(h, -0.4, 9.81);
  }
}

}  // namespace
}  // namespace couloir::test
