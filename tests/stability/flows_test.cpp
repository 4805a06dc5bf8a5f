// Dry beds, films, vacuum, collisions, extreme angles and cells.

#include "fixture.hpp"

namespace couloir::test {
namespace {

class Flows : public Stability {};

TEST_P(Flows, DryBedStaysDry) {
  for (double angle : {0.0, 45.0, 89.0}) {
    const auto flow = plane(degrees(angle), 20, 8, 0.05, 0.05).build(GetParam());
    FlowModel& solver = *flow;
    solver.advance_to(1);
    EXPECT_EQ(solver.volume(), 0);
    EXPECT_EQ(solver.max_speed(), 0);
    EXPECT_EQ(solver.time(), 1);
  }
}

// Films down to 1e-12 m on both sides of the depth from which they carry momentum, alone and under a heap that runs over them.
TEST_P(Flows, ThinFilms) {
  for (double angle : {0.0, 20.0, 45.0, 89.0}) {
    for (double dry : {1e-7, 1e-14}) {
      for (double film : {1e-12, 1e-9, 1e-6}) {
        for (bool with_heap : {false, true}) {
          Case c = plane(degrees(angle), 30, 6, 0.05, 0.05);
          c.settings.closure = granular(35, 25);
          c.settings.dry_depth = dry;
          c.fill([&](double x, double y) { return FlowState{with_heap ? film + heap(x - 0.4, y, 0.1, 0.3) : film, 0, 0}; });
          run(c, 200, std::to_string(angle) + " deg, film " + std::to_string(film * 1e12) + " pm");
        }
      }
    }
  }
}

// Above u = 2 c the flows part and leave a vacuum; below, (1 - u / 2c)^2 of the depth. The scheme comes to it from above, at
// about first order.
TEST_P(Flows, TwoFlowsApartLeaveAVacuum) {
  for (double froude : {0.5, 1.9, 2.5, 10.0}) {
    const double u = froude * std::sqrt(9.81 * 0.1), share = std::max(0.0, 1 - froude / 2), exact = share * share;
    const auto excess = [&](int n) {
      Case c = plane(0, n, 1, 2.0 / n, 2.0 / n);
      c.settings.sides = sides(Side::Kind::outflow, Side::Kind::wall);
      c.fill([&](double x, double) { return FlowState{0.1, x < 1 ? -0.1 * u : 0.1 * u, 0}; });
      const auto flow = c.build(GetParam());
      FlowModel& solver = *flow;
      Demands demands(c, GetParam(), solver);
      while (solver.time() < 0.2 / u) demands.step(std::min(solver.stable_dt(), 0.2 / u - solver.time() + 1e-12));
      demands.expect("Fr " + std::to_string(froude));
      return std::abs(solver.at(n / 2, 0).h / 0.1 - exact);
    };
    const double coarse = excess(100), fine = excess(400);
    std::printf("Fr %g: depth in the middle off by %.1e, %.1e of the depth\n", froude, coarse, fine);
    EXPECT_LT(fine, 0.6 * coarse) << froude;
    EXPECT_LT(fine, 0.01) << froude;
  }
}

// Two equal flows meet: the depth between is that of a shock at a wall, and no momentum appears.
TEST_P(Flows, HeadOnCollision) {
  for (double froude : {0.5, 3.0, 20.0}) {
    Case c = plane(0, 400, 1, 0.005, 0.005);
    const double h = 0.1, u = froude * std::sqrt(9.81 * h);
    c.fill([&](double x, double) { return FlowState{h, x < 1 ? h * u : -h * u, 0}; });
    const auto flow = c.build(GetParam());
    FlowModel& solver = *flow;
    Demands demands(c, GetParam(), solver);
    // u^2 = g (h2 - h)^2 (h2 + h) / (2 h h2): the exact depth behind both shocks, by bisection.
    double low = h, high = 1000 * h;
    for (int k = 0; k < 100; ++k) {
      const double h2 = 0.5 * (low + high);
      (9.81 * (h2 - h) * (h2 - h) * (h2 + h) / (2 * h * h2) < u * u ? low : high) = h2;
    }
    const double end = 0.03 * (low - h) / (h * u);  // the shocks have gone six cells
    while (solver.time() < end) demands.step(std::min(solver.stable_dt(), end - solver.time() + 1e-12));
    demands.expect("Fr " + std::to_string(froude));
    EXPECT_NEAR(solver.momentum()[0], 0, 1e-12 * 2 * h * u);
    EXPECT_NEAR(solver.at(197, 0).h, low, 0.05 * low) << froude;
  }
}

TEST_P(Flows, BasalFrictionNearAndEqualToInternal) {
  for (double phi : {10.0, 35.0, 60.0}) {
    for (double short_of : {0.0, 1e-15, 1e-12, 1e-8, 1e-4, 1e-2}) {
      Case c = plane(degrees(40), 30, 20, 0.05, 0.05);
      c.settings.closure = granular(phi, phi * (1 - short_of));
      c.fill([](double x, double y) { return FlowState{heap(x - 0.5, y, 0.2, 0.3), 0, 0}; });
      run(c, 150, "phi " + std::to_string(phi));
    }
  }
}

// Every degree from 0 to 89, K = 1 and active/passive. Where friction is above the slope, a moving heap stops and stays.
TEST_P(Flows, SlopesFromZeroTo89Degrees) {
  for (int angle = 0; angle <= 89; ++angle) {
    for (bool hydraulic : {true, false}) {
      Case c = plane(degrees(angle), 40, 8, 0.05, 0.05);
      c.settings.closure = granular(40, 28);
      if (hydraulic) c.settings.closure.earth_pressure = EarthPressure::hydraulic();
      c.fill([](double x, double y) {
        const double h = heap(x - 0.4, y, 0.1, 0.3);
        return FlowState{h, h, 0};
      });
      const std::string what = std::to_string(angle) + " deg";
      const auto flow = run(c, 150, what);
      FlowModel& solver = *flow;
      if (angle > 26) continue;
      solver.advance_to(solver.time() + 10);
      ASSERT_EQ(solver.max_speed(), 0) << what;
      const Bits rest = bits_of(solver);
      solver.advance_to(solver.time() + 10);
      EXPECT_EQ(bits_of(solver), rest) << what;
    }
  }
}

TEST_P(Flows, CellsTwentyTimesLongerThanWide) {
  for (double ratio : {20.0, 0.05}) {
    for (double angle : {0.0, 40.0}) {
      const double dx = 0.02 * std::sqrt(ratio), dy = 0.02 / std::sqrt(ratio);
      const int n = 400;
      const int nx = int(std::lround(std::sqrt(n / ratio))), ny = int(std::lround(std::sqrt(n * ratio)));
      Case c = plane(degrees(angle), nx, ny, dx, dy);
      c.settings.closure = granular(38, 28);
      c.bed.obstacles.push_back({"block", 0.25, 0.25 + 2 * dx, -0.05 - dy, 0.05 + dy, 0.05});
      c.fill([](double x, double y) { return FlowState{heap(x - 0.1, y, 0.06, 0.1), 0, 0}; });
      run(c, 300, "aspect " + std::to_string(ratio));
    }
  }
}

TEST_P(Flows, CourantNumberAtItsLimit) {
  for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee}) {
    for (double delta : {0.0, 25.0}) {
      Case c = plane(degrees(35), 40, 20, 0.05, 0.05);
      c.settings.closure = granular(30, delta);
      c.settings.limiter = limiter;
      c.settings.cfl = 0.5;
      c.bed.obstacles.push_back({"block", 1.0, 1.2, -0.15, 0.2, 0.1});
      c.fill([](double x, double y) {
        const double h = heap(x - 0.4, y, 0.15, 0.3);
        return FlowState{h, 3 * h, h};
      });
      run(c, 400, "limiter " + std::to_string(int(limiter)));
    }
  }
}

// Radius of the arc from four times the depth down to the depth.
TEST_P(Flows, CurvatureRadiusNearTheDepth) {
  for (double over : {4.0, 2.0, 1.1, 1.0}) {
    Case c = plane(degrees(50), 60, 10, 0.02, 0.02);
    const double depth = 0.1, radius = over * depth;
    c.arc = radius * c.angle, c.slope = 0.6, c.runout = 1.2 - c.slope - c.arc;
    c.settings.closure = granular(35, 25);
    c.fill([&](double x, double y) {
      const double h = heap(x - 0.4, y, depth, 0.2);
      return FlowState{h, h, 0};
    });
    run(c, 400, "radius / depth " + std::to_string(over));
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Flows, testing::ValuesIn(subjects()), subject_name);

}  // namespace
}  // namespace couloir::test
