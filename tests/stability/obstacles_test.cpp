// Walls of any height and slope, small obstacles, edges on and off the grid.

#include "fixture.hpp"

namespace couloir::test {
namespace {

class Obstacles : public Stability {
 protected:
  // A heap that runs down 40 deg.
  static Case chute(int nx, int ny, double dx) {
    Case c = plane(degrees(40), nx, ny, dx, dx);
    c.settings.closure = granular(37, 27);
    c.settings.sides = sides(Side::Kind::outflow, Side::Kind::wall);
    c.fill([](double x, double y) {
      const double h = heap(x - 0.3, y, 0.08, 0.25);
      return FlowState{h, 2 * h, 0};
    });
    return c;
  }
};

// A truncated pyramid of the bed: walls that rise 24 over 1, over one cell or less.
TEST_P(Obstacles, BedWallsOf24To1) {
  for (double slope : {1.0, 6.0, 24.0}) {
    for (double height : {0.02, 0.1, 0.48}) {
      for (bool hydraulic : {true, false}) {
        Case c = chute(60, 20, 0.02);
        if (hydraulic) c.settings.closure.earth_pressure = EarthPressure::hydraulic();
        for (int j = 0; j < 20; ++j) {
          for (int i = 0; i < 60; ++i) {
            const double inside = 0.1 - std::max(std::abs(c.grid().x(i) - 0.8), std::abs(c.grid().y(j)));
            c.bed.elevation.push_back(std::clamp(slope * inside, 0.0, height));
          }
        }
        run(c, 400, "slope " + std::to_string(slope) + ", height " + std::to_string(height));
      }
    }
  }
}

TEST_P(Obstacles, StepsAHundredTimesTheDepth) {
  for (double times : {1.0, 10.0, 100.0}) {
    Case c = chute(60, 20, 0.02);
    c.bed.obstacles.push_back({"tower", 0.7, 0.8, -0.1, 0.06, 0.08 * times});
    const auto flow = run(c, 400, std::to_string(times) + " times");
    FlowModel& solver = *flow;
    if (times > 1 && GetParam().has_steps) {
      for (int i = 35; i < 40; ++i) EXPECT_EQ(solver.at(i, 8).h, 0) << "nothing flows up a tower";
    }
  }
}

TEST_P(Obstacles, ReleaseOnTopOfOne) {
  for (double times : {1.0, 100.0}) {
    Case c = chute(60, 20, 0.02);
    c.bed.obstacles.push_back({"shelf", 0.2, 0.4, -0.1, 0.1, 0.08 * times});
    const auto flow = run(c, 400, std::to_string(times) + " times");
    FlowModel& solver = *flow;
    EXPECT_GT(solver.max_speed(), 0);
  }
}

TEST_P(Obstacles, OneCellWide) {
  for (double height : {0.01, 8.0}) {
    const double dx = 0x1.4p-6;  // 19.5 mm, short: mirrored cells have mirrored centres
    Case c = chute(61, 21, dx);
    c.bed.obstacles.push_back({"post", 36 * dx, 37 * dx, -0.4 * dx, 0.4 * dx, height});
    const auto flow = run(c, 400, "height " + std::to_string(height));
    FlowModel& solver = *flow;
    EXPECT_GT(solver.obstacle_impulse(0)[0], 0);
    EXPECT_EQ(solver.obstacle_impulse(0)[1], 0) << "the scene is symmetric to the bit";
  }
}

// An obstacle moved through a cell, along and across: its edges lie on grid lines, on cell centres and between. The force
// follows the cells that it covers, at most one more than its width.
TEST_P(Obstacles, EdgesOnAndOffTheGridLines) {
  for (int k = 0; k < 8; ++k) {
    for (bool along : {true, false}) {
      const double shift = 0.02 * k / 8.0;
      Case c = chute(60, 20, 0.02);
      const double x0 = 0.7 + (along ? shift : 0), y0 = -0.06 + (along ? 0 : shift);
      c.bed.obstacles.push_back({"block", x0, x0 + 0.06, y0, y0 + 0.12, 1.0});
      const std::string what = "shift " + std::to_string(shift) + (along ? " along" : " across");
      const auto flow = run(c, 300, what);
      FlowModel& solver = *flow;
      int covered = 0;
      for (int j = 0; j < 20; ++j) covered += c.bed.obstacles[0].covers(c.grid().x(36), c.grid().y(j)) ? 1 : 0;
      EXPECT_GE(covered, 6) << what;
      EXPECT_LE(covered, 7) << what;
      EXPECT_GT(solver.obstacle_impulse(0)[0], 0) << what;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Obstacles, testing::ValuesIn(subjects()), subject_name);

}  // namespace
}  // namespace couloir::test
