#include "coupling/transfer/handback.hpp"

#include <gtest/gtest.h>

namespace couloir {
namespace {

const Grid grid{100, 40, 0.01, 0.01, 0, -0.2};

struct Bench {
  ReferenceSurface surface = ReferenceSurface::incline(0.6, 1.0);
  Rim rim{grid, {30, 60, 10, 30}, surface, RimSettings{.diameter = 0.004}};
  Handback handback{rim, surface, 1100};
  std::vector<std::vector<Handback::Outside>> outside;
  std::vector<std::int64_t> remove;
  Bench() {
    for (const RimFace& f : rim.faces()) outside.emplace_back(f.segments, Handback::Outside{false, rim.buffer()});
  }
  Grains one(double x, double y, double u, double v) {
    Grains g;
    g.id = {5};
    g.x = {x};
    g.y = {y};
    g.z = {0.002};
    g.vx = {u};
    g.vy = {v};
    g.vz = {0};
    g.radius = {0.002};
    g.driven = {0};
    return g;
  }
};

TEST(Handback, GivesMassAndMomentumOnceToTheCellOutside) {
  Bench b;
  const double m = grain_mass(0.002, 1100);
  b.handback.sort(b.one(0.601, 0.033, 2.0, 0.5), b.outside, b.remove);
  EXPECT_DOUBLE_EQ(b.handback.pending_mass(), m);
  const Parcel& p = b.handback.pending()[1][13];  // downstream face, y = 0.033 -> cell (0.033 + 0.1) / 0.01
  EXPECT_DOUBLE_EQ(p.mass, m);
  EXPECT_NEAR(p.mom_x, 2.0 * m, 1e-15);
  EXPECT_NEAR(p.mom_y, 0.5 * m, 1e-15);
  EXPECT_TRUE(b.handback.is_shadow(5));
  b.handback.sort(b.one(0.62, 0.033, 2.0, 0.5), b.outside, b.remove);
  EXPECT_DOUBLE_EQ(b.handback.pending_mass(), m) << "a shadow is not counted again";
  EXPECT_TRUE(b.remove.empty());
  EXPECT_EQ(b.handback.returned(), 1);
}

TEST(Handback, AllFourFacesTakeGrains) {
  for (const auto& [x, y] : {std::pair{0.299, 0.0}, {0.601, 0.0}, {0.45, -0.101}, {0.45, 0.101}}) {
    Bench b;
    b.handback.sort(b.one(x, y, 1, 0), b.outside, b.remove);
    EXPECT_GT(b.handback.pending_mass(), 0) << x << " " << y;
  }
}

TEST(Handback, ShadowsEndAtTheBuffersFarSide) {
  Bench b;
  b.handback.sort(b.one(0.601, 0, 2, 0), b.outside, b.remove);
  b.handback.sort(b.one(0.6 + b.rim.buffer() + 1e-4, 0, 2, 0), b.outside, b.remove);
  ASSERT_EQ(b.remove.size(), 1u);
  EXPECT_EQ(b.remove[0], 5);
}

TEST(Handback, AShadowThatComesBackTakesItsMassBack) {
  Bench b;
  b.handback.sort(b.one(0.601, 0, 2, 0), b.outside, b.remove);
  b.handback.sort(b.one(0.599, 0, -1, 0), b.outside, b.remove);
  EXPECT_NEAR(b.handback.pending_mass(), 0, 1e-20);
  EXPECT_FALSE(b.handback.is_shadow(5));
}

TEST(Handback, WhereTheFlowComesInAGrainIsRemovedOneDiameterOut) {
  Bench b;
  for (auto& o : b.outside[0]) o.inflow = true;
  b.handback.sort(b.one(0.3 - 0.003, 0, -1, 0), b.outside, b.remove);
  EXPECT_TRUE(b.remove.empty());
  EXPECT_EQ(b.handback.pending_mass(), 0);
  b.handback.sort(b.one(0.3 - 0.0045, 0, -1, 0), b.outside, b.remove);
  EXPECT_EQ(b.remove.size(), 1u);
  EXPECT_GT(b.handback.pending_mass(), 0);
}

TEST(Handback, DrivenGrainsAreNotItsBusiness) {
  Bench b;
  Grains g = b.one(0.29, 0, 1, 0);
  g.driven = {1};
  b.handback.sort(g, b.outside, b.remove);
  EXPECT_EQ(b.handback.pending_mass(), 0);
  EXPECT_TRUE(b.remove.empty());
}

}  // namespace
}  // namespace couloir
