#include <gtest/gtest.h>

#include "bodies.hpp"

namespace couloir::test {
namespace {

constexpr double cell = 0.1 * unit;

SolverSettings pool(int nx, int ny) {
  SolverSettings s;
  s.grid = {nx, ny, cell, cell, 13 * unit, -0.5 * ny * cell};
  s.sides = sides(Side::Kind::wall, Side::Kind::wall);
  s.block = 16;
  return s;
}

double departure(const Solver& s, const Bits& start) {
  const Bits now = bits(s);
  double most = 0;
  for (std::size_t k = 0; k < now.h.size(); ++k) {
    most = std::max({most, std::abs(now.h[k] - start.h[k]), std::abs(now.hu[k]), std::abs(now.hv[k])});
  }
  return most;
}

// Blocks with a body and blocks without share faces: what one gives the other gets, with every limiter.
TEST(ElevationFlow, MassIsKeptBetweenBlocks) {
  for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee}) {
    SolverSettings s = pool(80, 70);
    s.limiter = limiter;
    s.closure = quartz();
    const Elevation body = wall_24_to_1(17 * unit);
    Solver solver(s, ReferenceSurface::incline(degrees(35), 25 * unit), bed_of(body, s.grid));
    solver.set([&](double x, double y) { return FlowState{std::max(0.0, unit - std::hypot(x - 15 * unit, y)), 0.0, 0.0}; });
    const double volume = solver.volume();
    solver.advance_to(0.3);
    EXPECT_NEAR(solver.volume(), volume + solver.budget().mass_boundary, 1e-13 * volume);
  }
}

// K = 1, no friction: the surface lies below the top and above it.
TEST(ElevationFlow, LakeOverEitherBodyStaysToRoundOff) {
  for (const Elevation& body : {wall_24_to_1(15 * unit), wedge()}) {
    for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee}) {
      for (double level : {0.7 * unit, 3 * unit}) {
        SolverSettings s = pool(60, 70);
        s.limiter = limiter;
        Solver solver(s, ReferenceSurface::flat(20 * unit), bed_of(body, s.grid));
        solver.set([&](double x, double y) { return FlowState{std::max(0.0, level - body.at(x, y)), 0, 0}; });
        const Bits start = bits(solver);
        for (int k = 0; k < 100; ++k) solver.step(1);
        EXPECT_LT(departure(solver, start), 1e-14) << body.bodies()[0].name() << " level " << level;
        EXPECT_GE(solver.min_depth(), 0);
      }
    }
  }
}

// A pile that friction can hold keeps every bit: K h + z_b rises by at most 0.9 of the spare friction. It leans on the body, for
// any K that is the same in both directions; with quartz it lies before the wall's foot, which stands above it.
TEST(ElevationFlow, PileOnEitherBodyIsBitwiseStill) {
  const double mu = std::tan(degrees(28));
  const auto constant = [&](double k) { return Closure{{k, k, k, k, k, k}, mu, true}; };
  for (const Elevation& body : {wall_24_to_1(15 * unit), wedge()}) {
    const std::string name = body.bodies()[0].name();
    for (const Closure& closure : {constant(1), constant(0.7), constant(2.5), quartz()}) {
      const double k = closure.earth_pressure.x_active;
      const bool anisotropic = closure.earth_pressure.y_active_active != k;
      if (anisotropic && name == "wedge") continue;  // K_x h + z_b and K_y h + z_b cannot both be level on its faces
      for (double zeta : {0.0, 20.0}) {
        SolverSettings s = pool(60, 60);
        s.closure = closure;
        const double slope = 0.9 * (mu - std::tan(degrees(zeta)));
        Solver solver(s, ReferenceSurface::incline(degrees(zeta), 20 * unit), bed_of(body, s.grid));
        solver.set([&](double x, double y) {
          const double surface = slope * (1.5 * unit - std::hypot(x - 14.4 * unit, y));
          return FlowState{std::max(0.0, (surface - body.at(x, y)) / k), 0, 0};
        });
        const Bits start = bits(solver);
        int leaning = 0;
        for (int j = 0; j < 60; ++j) {
          for (int i = 0; i < 60; ++i) leaning += solver.at(i, j).h > 0 && body.at(s.grid.x(i) + s.grid.dx, s.grid.y(j)) > 0;
        }
        EXPECT_GT(leaning, 3) << name;
        for (int n = 0; n < 100; ++n) solver.step(1e-3);
        EXPECT_TRUE(bits(solver) == start) << name << ", K " << k << ", " << zeta << " deg, departs by "
                                           << departure(solver, start);
      }
    }
  }
}

// Quartz runs down 40 deg onto the body and over it, and then dry bumps get wet and dry again.
TEST(ElevationFlow, MassIsKeptAndDepthsStayPositiveOverSteepBodies) {
  for (const Elevation& body : {wall_24_to_1(6 * unit), wedge(5 * unit)}) {
    SolverSettings s;
    s.grid = {120, 64, cell, cell, 0, -32 * cell};
    s.sides = sides(Side::Kind::outflow, Side::Kind::wall);
    s.closure = quartz();
    s.block = 16;
    Solver solver(s, ReferenceSurface::incline(degrees(40), 12 * unit), bed_of(body, s.grid));
    solver.set([&](double x, double y) {
      const double r = 1 - std::pow((x - 2 * unit) / (2 * unit), 2) - std::pow(y / (2.5 * unit), 2);
      const double h = r > 0 ? 2.6 * unit * std::sqrt(r) : 0.0;
      return FlowState{h, 1.2 * h, 0};
    });
    const double volume = solver.volume();
    double on_top = 0, fastest = 0;
    for (int k = 1; k <= 12; ++k) {
      solver.advance_to(0.05 * k);
      fastest = std::max(fastest, solver.max_speed());
      for (int j = 0; j < 64; ++j) {
        for (int i = 0; i < 120; ++i) {
          const bool top = body.at(s.grid.x(i), s.grid.y(j)) > 0.8 * body.bodies()[0].height();
          if (top) on_top = std::max(on_top, solver.at(i, j).h);
        }
      }
    }
    EXPECT_GT(on_top, 0.05 * unit) << body.bodies()[0].name();
    EXPECT_GE(solver.min_depth(), 0);
    EXPECT_EQ(solver.budget().mass_clipped, 0);
    EXPECT_NEAR(solver.volume(), volume + solver.budget().mass_boundary, 1e-13 * volume);
    // Nothing gains more than the head of the start: velocity, slope, depth and pressure of the passive state.
    const double head = 1.2 * 1.2 / 2 + 9.81 * (12 * unit * std::sin(degrees(40)) + 4.2 * 2.6 * unit);
    EXPECT_LT(fastest, std::sqrt(2 * head)) << body.bodies()[0].name();
    std::printf("%s: on top %.2f units, fastest %.2f m/s, %ld steps\n", body.bodies()[0].name().c_str(), on_top / unit, fastest,
                static_cast<long>(solver.steps()));
  }
}

// A wall that nothing passes takes K p(h), never more, whatever K says about the bed's push: no flow is drawn to its foot.
TEST(ElevationFlow, SteepFootDoesNotPull) {
  for (double k : {0.6, 1.0, 4.0}) {
    SolverSettings s = pool(40, 1);
    s.closure.earth_pressure.x_active = s.closure.earth_pressure.x_passive = k;
    Elevation body;
    body.add(ElevationBody::cuboid(0, "wall", 15 * unit, 20 * unit, -5 * unit, 5 * unit, 40 * unit, cell, cell));
    Solver solver(s, ReferenceSurface::flat(20 * unit), bed_of(body, s.grid));
    solver.set([&](double x, double) { return FlowState{x < 15 * unit ? 0.5 * unit : 0.0, 0, 0}; });
    const double volume = solver.volume();
    solver.advance_to(0.2);
    EXPECT_LT(solver.max_speed(), 1e-12) << k;
    EXPECT_NEAR(solver.volume(), volume, 1e-15 * volume);
    const double exact = cell * 0.5 * k * 9.81 * 0.25 * unit * unit;
    EXPECT_NEAR(solver.obstacle_impulse(0)[0] / solver.time(), exact, 1e-12 * exact) << k;
  }
}

TEST(ElevationFlow, RefusesOwnersThatAreNotObstacles) {
  SolverSettings s = pool(4, 4);
  StepBed bed = bed_of(wedge(), s.grid);
  bed.owner[3] = 1;
  EXPECT_THROW(Solver(s, ReferenceSurface::flat(20 * unit), bed), std::invalid_argument);
  bed.owner.pop_back();
  EXPECT_THROW(Solver(s, ReferenceSurface::flat(20 * unit), bed), std::invalid_argument);
}

}  // namespace
}  // namespace couloir::test
