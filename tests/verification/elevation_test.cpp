#include "continuum/terrain/elevation.hpp"

#include <gtest/gtest.h>

#include "continuum/exact/normal_shock.hpp"
#include "convergence.hpp"
#include "errors.hpp"

namespace couloir::test {
namespace {

// references.md 2f at a wall of bed elevation that rises by 100 m within one cell: the bed's push is the force of the solid wall.
// The domain's wall is the same flow once more, by the momentum through the side.
TEST(ElevationShock, ForceOfASteepWallAndOfTheDomainsWall) {
  for (double froude : {1.0, 2.0, 3.0, 5.0, 7.0}) {
    for (bool elevation : {true, false}) {
      const double zeta = degrees(30), g = 9.81 * std::cos(zeta), h1 = 0.05, u1 = froude * std::sqrt(g * h1);
      const double eta = exact::normal_shock_depth_ratio(froude), speed = u1 / (eta - 1);
      const double length = 2, wall = elevation ? 1.9 : 2.0;
      SolverSettings settings = row(400, 0, length, Side::Kind::wall);
      settings.sides[0] = {Side::Kind::inflow, h1, u1};
      settings.closure.tan_delta = std::tan(zeta);
      StepBed bed;
      if (elevation) {
        const auto body = ElevationBody::cuboid(0, "wall", wall, 9, -9, 9, 100, settings.grid.dx, settings.grid.dx);
        for (int i = 0; i < 400; ++i) {
          bed.elevation.push_back(body.at(settings.grid.x(i), settings.grid.y(0)));
          bed.owner.push_back(bed.elevation.back() > 0 ? 0 : -1);
        }
        bed.obstacles.push_back({"wall", wall, 9, -9, 9, 0});
      }
      Solver s(settings, ReferenceSurface::incline(zeta, length), bed);
      s.set([&](double x, double) { return x < wall ? FlowState{h1, h1 * u1, 0} : FlowState{}; });
      const double t_end = 1.2 / speed;
      s.advance_to(0.5 * t_end);
      const auto impulse = [&] { return elevation ? s.obstacle_impulse(0)[0] : -s.budget().sides[1][0]; };
      const double before = impulse();
      s.advance_to(t_end);
      const double force = (impulse() - before) / (0.5 * t_end) / settings.grid.dy, exact_force = 0.5 * g * h1 * h1 * eta * eta;
      EXPECT_NEAR(force, exact_force, 0.01 * exact_force) << "Fr " << froude << " elevation " << elevation;
      std::printf("Fr %g %s: force/exact %.4f\n", froude, elevation ? "elevation" : "side", force / exact_force);
    }
  }
}

// With K = 2 everywhere the bed's push, which carries no K, and the pressure, which does, keep their order over relief.
std::vector<double> hump(int n, Limiter limiter) {
  SolverSettings s = row(n, 0, 1, Side::Kind::periodic);
  s.limiter = limiter;
  s.closure.earth_pressure = {2, 2, 2, 2, 2, 2};
  StepBed bed;
  for (int i = 0; i < n; ++i) bed.elevation.push_back(0.02 * std::cos(2 * pi * s.grid.x(i)));
  Solver solver(s, ReferenceSurface::flat(1), bed);
  solver.set([](double x, double) {
    const double h = 0.2 + 0.02 * std::sin(2 * pi * x);
    return FlowState{h, 0.3 * h, 0};
  });
  solver.advance_to(0.12);
  std::vector<double> h;
  for (int i = 0; i < n; ++i) h.push_back(solver.at(i, 0).h);
  return h;
}

TEST(ElevationOrder, SecondOrderOverReliefForAnyK) {
  const auto reference = hump(3200, Limiter::mc);
  for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc}) {
    const double e100 = error_to_finer(hump(100, limiter), reference), e400 = error_to_finer(hump(400, limiter), reference);
    std::printf("K = 2 over relief, limiter %d: L1 %.3e %.3e, order %.2f\n", static_cast<int>(limiter), e100, e400,
                order(e100, e400, 4));
    EXPECT_GT(order(e100, e400, 4), limiter == Limiter::minmod ? 1.7 : 1.8);
  }
}

// K h + z_b = const is the rest of a frictionless flow with constant K: kept to round-off on planes and across their kink.
TEST(ElevationOrder, RestOfAnyKOnPlanes) {
  for (double k : {0.6, 1.0, 4.0}) {
    SolverSettings s = row(80, 0, 1, Side::Kind::wall);
    s.closure.earth_pressure = {k, k, k, k, k, k};
    const auto bed_at = [](double x) { return 0.1 * std::max(0.0, x - 0.5); };
    StepBed bed;
    for (int i = 0; i < 80; ++i) bed.elevation.push_back(bed_at(s.grid.x(i)));
    Solver solver(s, ReferenceSurface::flat(1), bed);
    solver.set([&](double x, double) { return FlowState{0.1 - bed_at(x) / k, 0, 0}; });
    solver.advance_to(0.5);
    EXPECT_LT(solver.max_speed(), 1e-13) << k;
  }
}

}  // namespace
}  // namespace couloir::test
