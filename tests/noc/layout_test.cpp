#include "continuum/noc/nested/layout.hpp"

#include <gtest/gtest.h>

namespace couloir::noc {
namespace {

const Grid grid{40, 30, 0.1, 0.1, 0, -1.5};

std::vector<PatchPlace> lay(std::vector<RefineBox> boxes, bool periodic_y = false) {
  Refinement refinement;
  refinement.boxes = std::move(boxes);
  return lay_patches(grid, refinement, false, periodic_y, 2);
}

void expect_box(const CellBox& is, const CellBox& should) {
  EXPECT_EQ(is.i0, should.i0);
  EXPECT_EQ(is.i1, should.i1);
  EXPECT_EQ(is.j0, should.j0);
  EXPECT_EQ(is.j1, should.j1);
}

TEST(NocLayout, ABoxGrowsToWholeCellsOfItsParent) {
  const auto places = lay({{1.02, 1.5, -0.3, 0.21, 1, 0}});
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].parent, -1);
  expect_box(places[0].foot, {10, 15, 12, 18});
}

// The child's foot is counted in cells of 0.05; five of them, or 0.4 m, and whole cells of the base.
TEST(NocLayout, AParentIsLargerByTheMargin) {
  auto places = lay({{1.5, 2, -0.3, 0.2, 2, 0}});
  ASSERT_EQ(places.size(), 2u);
  expect_box(places[1].foot, {30, 40, 24, 34});
  EXPECT_EQ(places[1].parent, 0);
  expect_box(places[0].foot, {12, 23, 9, 20});
  places = lay({{1.5, 2, -0.3, 0.2, 2, 0.4}});
  expect_box(places[0].foot, {11, 24, 8, 21});
}

TEST(NocLayout, WhatTouchesOrOverlapsBecomesOne) {
  const auto apart = lay({{0.5, 1, 0, 0.5, 1, 0}, {1.2, 1.7, 0, 0.5, 1, 0}});
  EXPECT_EQ(apart.size(), 2u);
  const auto one = lay({{0.5, 1, 0, 0.5, 1, 0}, {1, 1.7, 0.3, 0.8, 1, 0}});
  ASSERT_EQ(one.size(), 1u);
  expect_box(one[0].foot, {5, 17, 15, 23});
  const auto parents = lay({{0.9, 1.4, 0, 0.5, 2, 0}, {1.7, 2.2, 0, 0.5, 2, 0}});  // children apart, parents not
  ASSERT_EQ(parents.size(), 3u);
  EXPECT_EQ(parents[1].parent, 0);
  EXPECT_EQ(parents[2].parent, 0);
}

TEST(NocLayout, NearASideItReachesTheSide) {
  expect_box(lay({{0.15, 1, -1.5, 1.42, 1, 0}})[0].foot, {0, 10, 0, 30});
  expect_box(lay({{1, 2, -1.5, 0, 1, 0}}, true)[0].foot, {10, 20, 0, 30});
  expect_box(lay({{1, 2, -1.2, 0, 1, 0}}, true)[0].foot, {10, 20, 3, 15});
}

}  // namespace
}  // namespace couloir::noc
