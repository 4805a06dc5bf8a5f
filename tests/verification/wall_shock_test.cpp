#include <gtest/gtest.h>

#include "continuum/exact/normal_shock.hpp"
#include "convergence.hpp"

namespace couloir::test {
namespace {

// references.md 2f: the table itself.
TEST(WallShock, ExactRatios) {
  const double froude[] = {1, 2, 3, 5, 7}, eta[] = {2.170086, 3.493959, 4.863990, 7.649775, 10.457629};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(exact::normal_shock_depth_ratio(froude[k]), eta[k], 5e-7);
}

// A uniform flow on a slope with delta = zeta runs against a wall: depth behind the shock, the shock's position, the force. The
// wall is the domain's side or a step obstacle. Behind the shock the material is at rest and held.
TEST(WallShock, DepthPositionAndForce) {
  for (double froude : {1.0, 2.0, 3.0, 5.0, 7.0}) {
    for (bool obstacle : {false, true}) {
      const double zeta = degrees(30), g = 9.81 * std::cos(zeta), h1 = 0.05, u1 = froude * std::sqrt(g * h1);
      const double eta = exact::normal_shock_depth_ratio(froude), speed = u1 / (eta - 1);
      const double length = 2, wall = obstacle ? 1.9 : 2.0;
      SolverSettings settings = row(400, 0, length, Side::Kind::wall);
      settings.sides[0] = {Side::Kind::inflow, h1, u1};
      settings.closure.tan_delta = std::tan(zeta);
      StepBed bed;
      if (obstacle) bed.obstacles.push_back({"wall", wall, 9, -9, 9, 100});
      Solver s(settings, ReferenceSurface::incline(zeta, length), bed);
      s.set([&](double x, double) { return x < wall ? FlowState{h1, h1 * u1, 0} : FlowState{}; });
      const double travel = 1.2, t_end = travel / speed;
      s.advance_to(0.5 * t_end);
      const double width = settings.grid.dy;
      const auto impulse = [&] { return obstacle ? s.obstacle_impulse(0)[0] : 0.0; };
      const double before = impulse();
      s.advance_to(t_end);

      const int last = static_cast<int>(std::lround(wall / settings.grid.dx)) - 1;
      double behind = 0;
      for (int i = last - 150; i < last - 50; ++i) behind += s.at(i, 0).h / 100;
      EXPECT_NEAR(behind / h1, eta, 0.01 * eta) << "Fr " << froude << " obstacle " << obstacle;

      double position = 0;  // where the depth crosses the mean of both sides
      for (int i = last; i > 0 && position == 0; --i) {
        const double mid = 0.5 * (1 + eta) * h1, a = s.at(i - 1, 0).h, b = s.at(i, 0).h;
        if (a < mid && b >= mid) position = s.grid().x(i - 1) + s.grid().dx * (mid - a) / (b - a);
      }
      EXPECT_NEAR(wall - position, travel, 0.01 * travel) << "Fr " << froude << " obstacle " << obstacle;
      std::printf("Fr %g %s: eta %.4f (%.4f), shock %.4f (%.4f)", froude, obstacle ? "obstacle" : "side", behind / h1, eta,
                  wall - position, travel);
      if (obstacle) {
        const double force = (impulse() - before) / (0.5 * t_end) / width, exact_force = 0.5 * g * h1 * h1 * eta * eta;
        EXPECT_NEAR(force, exact_force, 0.01 * exact_force) << "Fr " << froude;
        std::printf(", force/exact %.4f", force / exact_force);
      }
      std::printf("\n");
    }
  }
}

}  // namespace
}  // namespace couloir::test
