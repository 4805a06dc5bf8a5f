#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "continuum/errors.hpp"
#include "noc_scenes.hpp"

namespace couloir::test {
namespace {

TEST(NocState, CheckpointContinuesToTheSameBits) {
  NocSolver whole = heap_on_bump(1);
  whole.add_gauge(30, 0, 40);
  whole.advance_to(0.25);
  const auto bytes = whole.checkpoint();
  whole.advance_to(0.6);
  NocSolver again = heap_on_bump(2);
  again.advance_to(0.1);  // leaves its traces on the corners
  again.restore(bytes);
  EXPECT_EQ(again.time(), 0.25);
  again.advance_to(0.6);
  EXPECT_EQ(bits_of(again), bits_of(whole));
  EXPECT_EQ(again.checkpoint(), whole.checkpoint());
  EXPECT_EQ(again.gauge(0), whole.gauge(0));
}

TEST(NocState, CheckpointOfAnotherSolverIsRefused) {
  Solver upwind(basin(8, 8, 0.1), ReferenceSurface::flat(1), {});
  NocSolver small(basin(8, 8, 0.1), ReferenceSurface::flat(1), {});
  EXPECT_THROW(small.restore(upwind.checkpoint()), std::invalid_argument);
  EXPECT_THROW(heap_on_bump(1).restore(small.checkpoint()), std::invalid_argument);
  auto bytes = small.checkpoint();
  bytes.pop_back();
  EXPECT_THROW(small.restore(bytes), std::invalid_argument);
}

TEST(NocState, CflAboveOneHalfIsRefused) {
  SolverSettings s = basin(8, 8, 0.1);
  s.cfl = 0.5;
  NocSolver at_the_bound(s, ReferenceSurface::flat(1), {});
  s.cfl = 0.51;
  try {
    NocSolver above(s, ReferenceSurface::flat(1), {});
    FAIL() << "no error";
  } catch (const std::invalid_argument& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("at most 0.5, equation (3.22)"));
  }
}

// (3.22) holds for both half steps of every pair, with the speeds (3.23) of the centres at its start and end.
TEST(NocState, StepsKeepTheCflBound) {
  NocSolver s = heap_on_bump(1);
  const auto rate = [&] {
    double most = 0;
    for (int j = 0; j < 40; ++j) {
      for (int i = 0; i < 60; ++i) {
        const FlowState q = s.at(i, j);
        if (q.h < 1e-7) continue;
        most = std::max(most, (std::abs(q.hu) / q.h + std::sqrt(0.71341 * 9.81 * std::cos(degrees(35)) * q.h)) / 0.02);
      }
    }
    return most;
  };
  for (int k = 0; k < 200; ++k) {
    const double before = s.time(), bound = rate();
    s.step(1);
    ASSERT_LE(0.5 * (s.time() - before) * bound, 0.45 * (1 + 1e-6)) << k;
  }
}

TEST(NocState, WrongSettingsAreRefused) {
  const auto build = [](auto change) {
    SolverSettings s = basin(8, 8, 0.1);
    change(s);
    NocSolver(s, ReferenceSurface::flat(1), {});
  };
  EXPECT_THROW(build([](auto& s) { s.grid.nx = 0; }), std::invalid_argument);
  EXPECT_THROW(build([](auto& s) { s.threads = 0; }), std::invalid_argument);
  EXPECT_THROW(build([](auto& s) { s.dry_depth = 0; }), std::invalid_argument);
  EXPECT_THROW(build([](auto& s) { s.sides[2].kind = Side::Kind::periodic; }), std::invalid_argument);
  NocSolver solver(basin(8, 8, 0.1), ReferenceSurface::flat(1), {});
  EXPECT_THROW(solver.at(8, 0), std::out_of_range);
  EXPECT_THROW(solver.step(-1), std::invalid_argument);
  EXPECT_THROW(solver.add_gauge(9, 0, 8), std::out_of_range);
  SolverSettings eno = basin(8, 8, 0.1);
  eno.limiter = Limiter::eno;
  EXPECT_THROW(Solver(eno, ReferenceSurface::flat(1), {}), std::invalid_argument);
}

TEST(NocState, NotANumberIsReportedWithItsCell) {
  NocSolver solver(basin(20, 10, 0.1), ReferenceSurface::flat(2), {});
  solver.set([](double, double) { return FlowState{0.1, 0, 0}; });
  solver.set(12, 5, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  try {
    solver.step(0.01);
    FAIL() << "no error";
  } catch (const NumericsError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("at x = "));
    EXPECT_THAT(e.what(), testing::HasSubstr("h = nan"));
  }
}

// On the arc the curvature term alone: a thin, fast layer loses du/dx = -mu kappa u beside gravity and friction.
TEST(NocState, CurvatureAddsToFriction) {
  const auto speed_after = [](bool curvature) {
    SolverSettings s = row(200, 0, 2, Side::Kind::outflow);
    s.closure = {EarthPressure::hydraulic(), std::tan(degrees(20)), curvature};
    s.gravity = 1e-9;
    NocSolver solver(s, ReferenceSurface::chute(degrees(40), 0.5, 1.0, 0.5), {});
    solver.set([](double x, double) { return FlowState{x < 0.5 ? 0.01 : 0, x < 0.5 ? 0.05 : 0, 0}; });
    solver.advance_to(0.35);
    return solver.at(190, 0).hu / solver.at(190, 0).h;
  };
  EXPECT_NEAR(speed_after(false), 5, 1e-6);
  EXPECT_NEAR(speed_after(true), 5 * std::exp(-std::tan(degrees(20)) * degrees(40)), 0.01);
}

TEST(NocState, DryGroundCostsNothing) {
  SolverSettings s = basin(320, 320, 0.01);
  NocSolver solver(s, ReferenceSurface::flat(3.2), {});
  solver.set(5, 5, {0.1, 0, 0});
  solver.step(1);
  EXPECT_LE(solver.cell_updates(), 300);
  NocSolver empty(s, ReferenceSurface::flat(3.2), {});
  empty.advance_to(1);
  EXPECT_EQ(empty.time(), 1);
  EXPECT_EQ(empty.cell_updates(), 0);
}

}  // namespace
}  // namespace couloir::test
