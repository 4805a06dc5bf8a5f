// The measures of force on one body agree with each other.

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace couloir::test {
namespace {

CellBox around(const ElevationBody& b, const Grid& g, int margin) {
  const auto i = [&](double x) { return static_cast<int>(std::floor((x - g.x0) / g.dx + 1e-6)); };
  const auto j = [&](double y) { return static_cast<int>(std::floor((y - g.y0) / g.dy + 1e-6)); };
  return {i(b.x0()) - margin, i(b.x1()) + 1 + margin, j(b.y0()) - margin, j(b.y1()) + 1 + margin};
}

void expect_same(std::array<double, 2> a, std::array<double, 2> b, double scale) {
  for (int k : {0, 1}) EXPECT_NEAR(a[k], b[k], scale) << k;
}

// Step obstacle on a chute with arc, friction, earth pressure: blocked flux at its faces and control volume.
TEST(Force, ControlVolumeSeesTheStepsPressure) {
  Solver s = heap_on_block(1);
  const int box = s.add_control_box({33, 42, 11, 32}), whole = s.add_control_box({0, 60, 0, 40});
  for (int k = 1; k <= 10; ++k) {
    s.advance_to(0.08 * k);
    const auto by_faces = s.obstacle_impulse(0);
    expect_same(s.control_box_impulse(box), by_faces, 1e-13);
    expect_same(s.control_box_impulse(whole), by_faces, 1e-13);
  }
  EXPECT_GT(s.obstacle_impulse(0)[0], 1e-5);
}

// The same for a wedge and a 24 to 1 wall of elevation, quartz at 40 deg.
TEST(Force, ControlVolumeSeesTheBedsPush) {
  for (const Elevation& body : {wall_24_to_1(6 * unit), wedge(5 * unit)}) {
    const double cell = 0.1 * unit;
    SolverSettings settings;
    settings.grid = {120, 64, cell, cell, 0, -32 * cell};
    settings.sides = sides(Side::Kind::outflow, Side::Kind::wall);
    settings.closure = quartz();
    settings.block = 16;
    Solver s(settings, ReferenceSurface::incline(degrees(40), 12 * unit), bed_of(body, settings.grid));
    s.set([&](double x, double y) {
      const double r = 1 - std::pow((x - 2 * unit) / (2 * unit), 2) - std::pow((y - 0.5 * unit) / (2.4 * unit), 2);
      const double h = r > 0 ? 1.6 * unit * std::sqrt(r) : 0.0;
      return FlowState{h, 1.2 * h, 0};
    });
    const int box = s.add_control_box(around(body.bodies()[0], settings.grid, 2));
    const auto start = s.momentum();
    s.advance_to(0.3);
    const auto push = s.obstacle_impulse(0);
    const double scale = std::abs(push[0]) + std::abs(push[1]);
    EXPECT_GT(push[0], 0);
    EXPECT_GT(std::abs(push[1]), 0.001 * push[0]);  // the heap is off the centre line
    expect_same(s.control_box_impulse(box), push, 1e-12 * scale);
    EXPECT_NEAR(s.budget().obstacles[0], -push[0], 1e-13 * scale);
    const Budget& b = s.budget();
    const auto now = s.momentum();
    for (int k : {0, 1}) {
      const double sum = b.gravity[k] + b.friction[k] + b.boundary[k] + b.obstacles[k] + b.cutoff[k];
      EXPECT_NEAR(now[k] - start[k], sum, 2e-14 * std::abs(b.gravity[0]));
    }
  }
}

// Elevation that belongs to no obstacle stays gravity's.
TEST(Force, ReliefWithoutOwnerIsNoObstacle) {
  SolverSettings settings = basin(40, 20, 0.01);
  StepBed bed;
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 40; ++i) bed.elevation.push_back(0.02 * std::sin(20 * settings.grid.x(i)));
  }
  bed.obstacles.push_back({"nothing", 0.1, 0.2, -0.1, 0.1, 0});
  Solver s(settings, ReferenceSurface::flat(0.4), bed);
  s.set([](double x, double) { return FlowState{x < 0.2 ? 0.05 : 0.03, 0, 0}; });
  s.advance_to(0.1);
  EXPECT_EQ(s.obstacle_impulse(0)[0], 0);
  EXPECT_NE(s.budget().gravity[0], 0);
}

// A lake beside a cuboid: rho g h^2/2 w by the step's faces, by the bed's push and by the control volume.
TEST(Force, LakeAgainstACuboidIsTheHydrostaticForce) {
  const double h = 0.03, top = 0.08, cell = 0.01, width = 0.1;
  const double exact = 9.81 * h * h / 2 * width;
  for (bool step : {true, false}) {
    SolverSettings settings = basin(40, 20, cell);
    Elevation body;
    body.add(ElevationBody::cuboid(0, "cuboid", 0.2, 0.6, -0.05, 0.05, top, cell, cell));
    StepBed bed = bed_of(body, settings.grid);
    if (step) bed = {{}, {{"cuboid", 0.2, 0.6, -0.05, 0.05, top}}, {}};
    Solver s(settings, ReferenceSurface::flat(0.4), bed);
    // Water lower than the middle of the ramp's one cell, before it and beside it; its downstream end leans against the domain's
    // wall, so nothing balances the front.
    s.set([&](double x, double y) {
      const bool solid = x > 0.2 && std::abs(y) < 0.05;
      return FlowState{solid ? (step ? 0.0 : std::max(0.0, h - body.at(x, y))) : h, 0, 0};
    });
    const int box = s.add_control_box({18, 40, 3, 17});
    s.advance_to(0.2);
    EXPECT_LT(s.max_speed(), 1e-13);
    EXPECT_NEAR(s.obstacle_impulse(0)[0] / s.time(), exact, 1e-12 * exact) << step;
    EXPECT_NEAR(s.obstacle_impulse(0)[1] / s.time(), 0, 1e-12 * exact);
    // The domain's wall pushes on the flow beside the cuboid, inside the box: it is a face of the box.
    EXPECT_NEAR(s.control_box_impulse(box)[0] / s.time(), exact, 1e-12 * exact) << step;
    EXPECT_NEAR(-s.budget().sides[0][0] / s.time(), -9.81 * h * h / 2 * 0.2, 1e-12 * exact);  // upstream wall
    EXPECT_NEAR(-s.budget().sides[1][0] / s.time(), 9.81 * h * h / 2 * 0.1, 1e-12 * exact);   // what the lake reaches of the end
    EXPECT_NEAR(-s.budget().sides[2][1] / s.time(), -9.81 * h * h / 2 * 0.4, 1e-12 * exact);
  }
}

TEST(Force, ControlBoxIsKeptInTheCheckpointAndMustFit) {
  Solver a = heap_on_block(1);
  a.add_control_box({33, 42, 11, 32});
  a.advance_to(0.3);
  Solver b = heap_on_block(1);
  b.restore(a.checkpoint());
  a.advance_to(0.5), b.advance_to(0.5);
  EXPECT_EQ(a.control_box_impulse(0), b.control_box_impulse(0));
  EXPECT_NE(a.control_box_impulse(0)[0], 0);
  for (const CellBox& bad : {CellBox{3, 3, 0, 4}, CellBox{-1, 3, 0, 4}, CellBox{0, 61, 0, 4}, CellBox{0, 3, 0, 41}}) {
    EXPECT_THROW(a.add_control_box(bad), std::out_of_range);
  }
}

}  // namespace
}  // namespace couloir::test
