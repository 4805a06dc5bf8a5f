// Symmetry, threads, checkpoints, rest, refusals.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "plane_scenes.hpp"

namespace couloir {
namespace {

using namespace test;

bool same(const FlowState& a, const FlowState& b, double turn_u, double turn_v) {
  return a.h == b.h && a.hu == turn_u * b.hu && a.hv == turn_v * b.hv;
}

// a is b mirrored about y = 0, to the bit, slope and planes.
void expect_mirrored(const PlanesModel& a, const PlanesModel& b) {
  const int ny = a.grid().ny;
  long differ = 0;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < a.grid().nx; ++i) differ += !same(a.at(i, j), b.at(i, ny - 1 - j), 1, -1);
  }
  for (PlaneName p : {PlaneName::front, PlaneName::back, PlaneName::top}) {
    const Grid& g = a.plane(p).grid();
    for (int j = 0; j < g.ny; ++j) {
      for (int i = 0; i < g.nx; ++i) differ += !same(a.plane(p).at(i, j), b.plane(p).at(i, g.ny - 1 - j), 1, -1);
    }
  }
  const Grid& g = a.plane(PlaneName::left).grid();
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) differ += !same(a.plane(PlaneName::left).at(i, j), b.plane(PlaneName::right).at(i, j), 1, 1);
  }
  EXPECT_EQ(differ, 0);
}

TEST(PlanesState, AMirroredSceneGivesMirroredBits) {
  PlanesModel straight = dam({.eta = 0.9});
  straight.advance_to(0.55);
  EXPECT_GT(straight.plane(PlaneName::left).volume(), 0);
  EXPECT_GT(straight.overflow(), 0);
  expect_mirrored(straight, straight);
  PlanesModel skew = dam({.eta = 0.9, .skew = 0.04}), mirrored = dam({.eta = 0.9, .skew = 0.04, .mirror = -1});
  skew.advance_to(0.55);
  mirrored.advance_to(0.55);
  expect_mirrored(skew, mirrored);
}

TEST(PlanesState, ThreadsAndCheckpointsKeepTheBits) {
  PlanesModel one = dam({}), two = dam({.threads = 2});
  one.advance_to(0.4);
  two.advance_to(0.4);
  EXPECT_EQ(one.checkpoint(), two.checkpoint());
  PlanesModel third = dam({});
  third.restore(one.checkpoint());
  EXPECT_EQ(third.checkpoint(), one.checkpoint());
  one.advance_to(0.5);
  third.advance_to(0.5);
  EXPECT_EQ(third.checkpoint(), one.checkpoint());
  PlanesModel other = dam({.height = 4 * unit});
  EXPECT_THROW(other.restore(one.checkpoint()), std::invalid_argument);
}

// Below the angle of friction: a layer against all sides of the cuboid, deeper before its front.
TEST(PlanesState, AtRestNothingMoves) {
  const Dam d{.eta = 1, .zeta = degrees(15)};
  PlanesModel model = dam(d);
  const auto layer = [&](double x, double y) {
    const double before = 16.5 * unit - x;
    const bool heap = before > 0 && before < 6 * unit && std::abs(y) < 2 * unit;
    return FlowState{0.02 + (heap ? 0.002 * (1 - before / (6 * unit)) : 0.0), 0, 0};
  };
  model.set(layer);
  std::vector<double> h0, hu0, hv0, h, hu, hv;
  model.gather(h0, hu0, hv0);
  model.advance_to(1);
  model.gather(h, hu, hv);
  EXPECT_EQ(h, h0);
  EXPECT_EQ(hu, hu0);
  EXPECT_EQ(hv, hv0);
  EXPECT_EQ(model.plane(PlaneName::front).volume(), 0);
  EXPECT_GT(model.obstacle_impulse(0)[0], 0) << "it presses all the same";
}

// The cell's own state is that of the top plane on the footprint.
TEST(PlanesState, FootprintIsTheTopPlane) {
  PlanesModel model = dam({});
  const CellBox box = model.footprint();
  EXPECT_EQ(model.at(box.i0, box.j0).h, 0);
  model.set(box.i0 + 1, box.j0 + 2, {0.01, 0.02, 0.03});
  EXPECT_EQ(model.plane(PlaneName::top).at(1, 2).hu, 0.02);
  EXPECT_EQ(model.at(box.i0 + 1, box.j0 + 2).hv, 0.03);
}

TEST(PlanesState, RefusesWhatItCannotBuild) {
  const auto sentence = [](auto&& make) -> std::string {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(sentence([] { dam({.eta = 1.2}); }), testing::HasSubstr("must be from 0 to 1"));
  const Dam d;
  SolverSettings periodic = dam_settings(d);
  periodic.sides[2].kind = periodic.sides[3].kind = Side::Kind::periodic;
  StepBed wide = dam_bed({.whole_width = true}), far = dam_bed(d), upstream = dam_bed(d);
  far.obstacles[0].x0 = 50, far.obstacles[0].x1 = 51;
  upstream.obstacles[0].x0 = 0;
  const ReferenceSurface slope = ReferenceSurface::incline(d.zeta, 24 * unit);
  EXPECT_THAT(sentence([&] { PlanesModel(periodic, slope, wide, 0, 0.5); }), testing::HasSubstr("periodic side"));
  EXPECT_THAT(sentence([&] { PlanesModel(dam_settings(d), slope, far, 0, 0.5); }),
              testing::HasSubstr("hold the centre of a cell"));
  EXPECT_THAT(sentence([&] { PlanesModel(dam_settings(d), slope, upstream, 0, 0.5); }),
              testing::HasSubstr("slope before its front"));
}

}  // namespace
}  // namespace couloir
