// One face of an edge, pointwise.

#include "continuum/planes/edge_flux.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace couloir {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double g_slope = 7.5, g_front = 6.3;  // [m/s2]

EdgeFlux concave(const EdgeCell& slope, const EdgeCell& plane, double eta) {
  return concave_edge(slope, plane, eta, no_limit, no_limit);
}

TEST(PlanesEdge, FastFlowIsTurnedWhole) {
  const EdgeCell jet{0.01, 3, 0.4, g_slope};
  for (double eta : {0.6, 0.8, 1.0}) {
    const EdgeFlux f = concave(jet, {}, eta), heavy = concave(jet, {0, 0, 0, g_front}, eta);
    EXPECT_DOUBLE_EQ(f.mass, 0.01 * 3);
    EXPECT_DOUBLE_EQ(f.along, f.mass * 0.4);
    EXPECT_DOUBLE_EQ(f.normal_1, 0.01 * 9 + pressure(0.01, g_slope)) << "all of its momentum goes into the wall";
    // The share eta goes on along the plane; a plane without weight adds no pressure.
    EXPECT_NEAR(f.normal_2, eta * 0.01 * 9, 1e-15);
    EXPECT_NEAR(heavy.normal_2, eta * 0.01 * 9 + pressure(0.01 / eta, g_front), 1e-15);
  }
}

TEST(PlanesEdge, WithoutAShareItIsAWall) {
  for (double u : {-1.0, 0.0, 0.3, 3.0}) {
    const EdgeFlux f = concave({0.05, u, 0.2, g_slope}, {}, 0);
    EXPECT_EQ(f.mass, 0);
    EXPECT_EQ(f.along, 0);
    EXPECT_DOUBLE_EQ(f.normal_1, wall_flux(0.05, u, g_slope));
    EXPECT_EQ(f.normal_2, 0);
  }
}

TEST(PlanesEdge, RestPressesButPassesNothing) {
  const EdgeFlux dry = concave({0.05, 0, 0, g_slope}, {}, 1);
  EXPECT_EQ(dry.mass, 0);
  EXPECT_EQ(dry.normal_1, pressure(0.05, g_slope));
  EXPECT_EQ(dry.normal_2, 0);
  const EdgeFlux borne = concave({0.05, 0, 0, g_slope}, {0.02, 0, 0, g_front}, 1);
  EXPECT_EQ(borne.mass, 0) << "the slope's depth bears what lies on the plane";
  EXPECT_EQ(borne.normal_2, pressure(0.02, g_front));
  EXPECT_LT(concave({0.01, 0, 0, g_slope}, {0.02, 0, 0, g_front}, 1).mass, 0) << "as far as it reaches";
}

TEST(PlanesEdge, NeverTakesMoreThanFlowsIn) {
  for (double eta = 0; eta <= 1; eta += 0.05) {
    for (double u : {0.01, 0.2, 0.6, 1.5, 5.0}) {
      const EdgeFlux f = concave({0.05, u, 0, g_slope}, {}, eta);
      EXPECT_GE(f.mass, 0);
      EXPECT_LE(f.mass, 0.05 * u * (1 + 1e-15)) << eta << " " << u;
      EXPECT_LE(f.normal_2, 1.5 * eta * u * f.mass * (1 + 1e-15)) << eta << " " << u;
    }
  }
}

TEST(PlanesEdge, WhatFallsComesBackAtTheShareOfItsVelocity) {
  const EdgeFlux f = concave({}, {0.01, 2, 0.3, g_front}, 0.5);
  EXPECT_DOUBLE_EQ(f.mass, -0.02);
  EXPECT_DOUBLE_EQ(f.along, -0.02 * 0.3);
  EXPECT_GE(f.normal_1, 0.02 * 0.5 * 2) << "pushed away from the wall";
  EXPECT_DOUBLE_EQ(f.normal_2, 0.01 * 4 + pressure(0.01, g_front));
}

TEST(PlanesEdge, ConvexEdgeTurnsFastFlowWithoutLoss) {
  const EdgeFlux f = convex_edge({0.01, 3, 0.4, g_front}, {}, no_limit, no_limit);
  EXPECT_DOUBLE_EQ(f.mass, 0.03);
  EXPECT_DOUBLE_EQ(f.along, 0.03 * 0.4);
  EXPECT_DOUBLE_EQ(f.normal_1, 0.09 + pressure(0.01, g_front));
  EXPECT_EQ(f.normal_1, f.normal_2);
  const EdgeFlux back = convex_edge({}, {0.01, 3, 0.4, g_front}, no_limit, no_limit);
  EXPECT_EQ(back.mass, -f.mass);
  EXPECT_EQ(back.along, -f.along);
  EXPECT_EQ(back.normal_1, f.normal_1);
}

TEST(PlanesEdge, FreeEdgeLetsGoWhatLeavesAndNothingElse) {
  const EdgeFlux f = free_edge({0.01, 2, 0.3, 0}, no_limit);
  EXPECT_DOUBLE_EQ(f.mass, 0.02);
  EXPECT_DOUBLE_EQ(f.along, 0.006);
  EXPECT_DOUBLE_EQ(f.normal_1, 0.04);
  EXPECT_EQ(free_edge({0.01, -2, 0.3, 0}, no_limit).mass, 0);
  EXPECT_EQ(free_edge({0.01, 2, 0.3, 0}, 0.01).normal_1, 0.02);
}

TEST(PlanesEdge, CellsGiveNoMoreThanTheyHold) {
  const EdgeFlux up = concave_edge({0.05, 4, 0.1, g_slope}, {}, 1, 0.03, 0.01);
  EXPECT_EQ(up.mass, 0.03);
  const EdgeFlux both = concave_edge({0.05, 4, 0.1, g_slope}, {0.05, 4, 0.1, g_front}, 1, 0.03, 0.01);
  EXPECT_DOUBLE_EQ(both.mass, 0.02);
  const EdgeFlux over = convex_edge({0.05, 4, 0.1, g_front}, {}, 0.05, 0);
  EXPECT_EQ(over.mass, 0.05);
  EXPECT_DOUBLE_EQ(over.along, 0.05 * 0.1);
}

}  // namespace
}  // namespace couloir
