#include "coupling/scene/solid_body.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "body_meshes.hpp"

namespace couloir {
namespace {

using testing::HasSubstr;
constexpr double pi = std::numbers::pi;

SolidBody body(const std::vector<BodyTriangle>& triangles, double rotation = 0) {
  const TriangleMesh mesh = welded(triangles);
  EXPECT_EQ(flaw_of(mesh), "");
  return SolidBody(mesh, rotation);
}

std::vector<BodyTriangle> joined(std::vector<BodyTriangle> a, const std::vector<BodyTriangle>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double area(const std::vector<BodyTriangle>& triangles) {
  double sum = 0;
  for (const BodyTriangle& t : triangles) {
    const double p[] = {t[1][0] - t[0][0], t[1][1] - t[0][1], t[1][2] - t[0][2]};
    const double q[] = {t[2][0] - t[0][0], t[2][1] - t[0][1], t[2][2] - t[0][2]};
    sum += 0.5 * std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
  }
  return sum;
}

TEST(SolidBody, ABoxIsACuboid) {
  const SolidBody b = body(box(3, 3.02, 5, 5.1, 0, 0.08));
  EXPECT_NEAR(b.length(), 0.02, 1e-15);
  EXPECT_NEAR(b.width(), 0.1, 1e-15);
  EXPECT_EQ(b.height(), 0.08);
  EXPECT_NEAR(b.base_area(), 0.002, 1e-15);
  EXPECT_NEAR(b.plan_area(), 0.002, 1e-15);
  EXPECT_NEAR(b.crest_x(), 0.01, 1e-15);
  EXPECT_NEAR(b.crest_y0(), -0.05, 1e-15);
  EXPECT_NEAR(b.crest_y1(), 0.05, 1e-15);
  for (double x : {0.0, 0.004, 0.02})
    for (double y : {-0.05, 0.0, 0.031, 0.05}) EXPECT_EQ(b.top(x, y), 0.08) << x << " " << y;
  EXPECT_EQ(b.top(-1e-6, 0), 0);
  EXPECT_EQ(b.top(0.01, 0.050001), 0);
  EXPECT_NEAR(area(b.triangles()), 0.002 + 2 * 0.08 * 0.12, 1e-15);  // without its base
}

TEST(SolidBody, WhatReachesBelowTheBedIsCutOff) {
  // A pyramid upside down would grow downwards; this one's base lies half of its height below the bed.
  std::vector<BodyTriangle> pyramid;
  const std::vector<BodyPoint> foot{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}};
  for (int k = 0; k < 4; ++k) pyramid.push_back({foot[k], foot[(k + 1) % 4], {0, 0, 1}});
  pyramid.push_back({foot[0], foot[2], foot[1]});
  pyramid.push_back({foot[0], foot[3], foot[2]});
  const SolidBody b = body(pyramid);
  EXPECT_EQ(b.lowest(), -1);
  EXPECT_NEAR(b.length(), 1, 1e-15);
  EXPECT_NEAR(b.base_area(), 1, 1e-14);
  EXPECT_NEAR(b.top(0.5, 0), 1, 1e-15);
  EXPECT_NEAR(b.top(0.25, 0), 0.5, 1e-15);
  EXPECT_NEAR(b.crest_x(), 0.5, 0.06);
  for (const BodyTriangle& t : b.triangles())
    for (const BodyPoint& p : t) EXPECT_GE(p[2], 0);
}

TEST(SolidBody, ARotationIsCounterClockwiseSeenFromAbove) {
  const auto wedge = prism({{0, 0}, {2, 0}, {0, 1}}, 0, 1);  // its right angle at low x and low y
  const SolidBody plain = body(wedge), turned = body(wedge, pi / 2);
  EXPECT_TRUE(plain.covers(0.1, -0.4));
  EXPECT_FALSE(plain.covers(1.9, 0.4));
  EXPECT_NEAR(turned.length(), 1, 1e-12);
  EXPECT_NEAR(turned.width(), 2, 1e-12);
  EXPECT_TRUE(turned.covers(0.9, -0.9));
  EXPECT_FALSE(turned.covers(0.1, 0.9));
  EXPECT_NEAR(turned.plan_area(), 1, 1e-12);
}

TEST(SolidBody, AnOverhangCountsByItsUpperSurface) {
  // A table: a leg, and a wider board on it.
  const SolidBody b = body(joined(box(0.4, 0.6, -0.1, 0.1, 0, 0.5), box(0, 1, -0.5, 0.5, 0.5, 0.6)));
  EXPECT_EQ(b.top(0.1, 0.4), 0.6);
  EXPECT_NEAR(b.base_area(), 0.04, 1e-12);
  EXPECT_NEAR(b.plan_area(), 1, 1e-12);
}

TEST(SolidBody, OverlappingRoofsAreSeenOnce) {
  // Two boards over one another: the upper one hides half of the lower one.
  const SolidBody b = body(joined(box(0, 1, 0, 1, 0, 0.1), box(0.5, 1.5, 0, 1, 0.3, 0.4)));
  EXPECT_NEAR(b.plan_area(), 1.5, 1e-6);
  EXPECT_EQ(b.top(0.25, 0), 0.1);
  EXPECT_EQ(b.top(0.75, 0), 0.4);
}

TEST(SolidBody, ACatchingDamIsPassedAtItsMiddle) {
  const SolidBody b = body(half_ring(0.9, 1.0, 0.2, 64));
  EXPECT_NEAR(b.length(), 1, 1e-12);
  EXPECT_NEAR(b.width(), 2, 1e-3);
  EXPECT_NEAR(b.plan_area(), pi / 2 * (1 - 0.81), 1e-3);
  EXPECT_NEAR(b.crest_x(), 0.95, 0.01);  // the middle of the ring where it is farthest downstream
  EXPECT_NEAR(b.crest_y1() - b.crest_y0(), 2, 1e-2);
  EXPECT_FALSE(b.covers(0.5, 0));
  EXPECT_TRUE(b.covers(0.95, 0));
}

TEST(SolidBody, CutTrianglesKeepTheSurfaceAndTheirCommonEdges) {
  const auto whole = half_ring(0.9, 1.0, 0.2, 7);
  const auto cut = cut_to_size(whole, 0.06);
  EXPECT_GT(cut.size(), 4 * whole.size());
  EXPECT_NEAR(area(cut), area(whole), 1e-12);
  EXPECT_EQ(flaw_of(welded(cut)), "");  // no corner lies within another triangle's edge
  EXPECT_EQ(cut_to_size(whole, 10).size(), whole.size());
  EXPECT_NEAR(smallest_angle({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}), pi / 4, 1e-15);
}

TEST(TriangleMesh, SaysWhatKeepsItFromBeingABody) {
  const auto good = box(0, 1, 0, 1, 0, 1);
  auto open = good, turned = good, inside_out = good;
  open.pop_back();
  EXPECT_EQ(
      flaw_of(welded(open)),
      "is open: 3 edges have no triangle on the other side, one from [0 m, 0 m, 0 m] to [1 m, 1 m, 0 m]; close the surface, "
      "its base too");
  std::swap(turned[3][0], turned[3][1]);
  EXPECT_THAT(flaw_of(welded(turned)), HasSubstr("has triangles that are turned against their neighbours, along 3 edges"));
  for (BodyTriangle& t : inside_out) std::swap(t[0], t[1]);
  EXPECT_EQ(flaw_of(welded(inside_out)), "is turned inside out: its triangles look into the body; turn all of them");
  EXPECT_THAT(flaw_of(welded({{{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}}})), HasSubstr("has no triangle with an extent"));
}

TEST(TriangleMesh, DropsTrianglesWithoutExtent) {
  auto some = box(0, 1, 0, 1, 0, 1);
  some.push_back({{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}});
  const TriangleMesh mesh = welded(some);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.faces.size(), 12u);
}

}  // namespace
}  // namespace couloir
