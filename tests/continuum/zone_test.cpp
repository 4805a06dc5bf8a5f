#include <gtest/gtest.h>

#include "continuum/flow/flux.hpp"
#include "scenes.hpp"

namespace couloir::test {
namespace {

int faces(const CellBox& b, SideName s) {
  return is_across_x(s) ? b.j1 - b.j0 : b.i1 - b.i0;
}

// A uniform layer that slides at constant speed down a slope with delta = zeta, the zone across block edges.
TEST(Zone, UniformFlowWithItsExactFluxesStaysUniform) {
  SolverSettings s = basin(40, 40, 0.05);
  s.sides = sides(Side::Kind::periodic, Side::Kind::periodic);
  s.closure = {EarthPressure::hydraulic(), std::tan(degrees(30)), false};
  Solver solver(s, ReferenceSurface::incline(degrees(30), 2), {});
  const double h = 0.1, u = 1.5, g = 9.81 * std::cos(degrees(30));
  solver.set([&](double, double) { return FlowState{h, h * u, 0}; });
  const CellBox box{10, 20, 12, 33};
  solver.cover(box);
  for (SideName side : all_sides) {
    for (int k = 0; k < faces(box, side); ++k)
      solver.impose(0, side, k, is_across_x(side) ? flux_x(h, u, 0, g) : flux_y(h, u, 0, g));
  }
  const double volume = solver.volume();
  solver.advance_to(2);
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 40; ++i) {
      EXPECT_NEAR(solver.at(i, j).h, h, 1e-13);
      EXPECT_NEAR(solver.at(i, j).hu, h * u, 1e-13);
      EXPECT_NEAR(solver.at(i, j).hv, 0, 1e-13);
    }
  }
  EXPECT_NEAR(solver.passed(0, SideName::upstream, 3).mass, h * u * 2, 1e-12);
  EXPECT_NEAR(solver.passed(0, SideName::left, 3).mom_y, pressure(h, g) * 2, 1e-12);
  EXPECT_NEAR(solver.volume(), volume, 1e-13);
  EXPECT_NEAR(solver.budget().mass_zone, 0, 1e-13);
}

// More is asked than there is: the flux is scaled, nothing turns negative, nothing is lost.
TEST(Zone, ImposedFluxNeverEmptiesACell) {
  SolverSettings s = basin(40, 20, 0.05);
  Solver solver(s, ReferenceSurface::flat(2), {});
  solver.set([](double x, double) { return FlowState{0.02 + 0.05 * std::exp(-20 * (x - 0.5) * (x - 0.5)), 0, 0}; });
  const CellBox box{18, 40, 4, 16};
  solver.cover(box);
  const double volume = solver.volume();
  for (int k = 0; k < 12; ++k) solver.impose(0, SideName::upstream, k, {5, 10, 1});
  for (int k = 0; k < 22; ++k) {
    solver.impose(0, SideName::left, k, {1, 0.1, 2});
    solver.impose(0, SideName::right, k, {-1, 0.1, 2});
  }
  for (int k = 0; k < 50; ++k) solver.step(0.005);
  double passed = 0;
  for (int k = 0; k < 12; ++k) passed += solver.passed(0, SideName::upstream, k).mass * 0.05;
  for (int k = 0; k < 22; ++k)
    passed += (solver.passed(0, SideName::left, k).mass - solver.passed(0, SideName::right, k).mass) * 0.05;
  EXPECT_GT(passed, 0.05 * volume);
  EXPECT_NEAR(solver.volume() + passed, volume + solver.budget().mass_clipped, 1e-14);
  EXPECT_NEAR(solver.budget().mass_zone, -passed, 1e-14);
  EXPECT_GE(solver.min_depth(), 0);
  const auto p = solver.momentum();
  const Budget& b = solver.budget();
  EXPECT_NEAR(p[0], b.boundary[0] + b.zone[0] + b.cutoff[0] + b.gravity[0], 1e-13);
  EXPECT_NEAR(p[1], b.boundary[1] + b.zone[1] + b.cutoff[1] + b.gravity[1], 1e-13);
}

TEST(Zone, CoveredCellsKeepTheStateGiven) {
  Solver solver = heap_on_block(1);
  solver.cover({30, 60, 10, 30});
  solver.set_covered(35, 20, {0.2, 0.1, -0.1});
  solver.advance_to(0.3);
  EXPECT_EQ(solver.at(35, 20).h, 0.2);
  EXPECT_EQ(solver.at(35, 20).hv, -0.1);
  EXPECT_EQ(solver.obstacle_impulse(0)[0], 0);  // the block is covered: not the solver's business
  EXPECT_THROW(solver.set_covered(2, 2, {}), std::out_of_range);
  EXPECT_THROW(solver.cover({30, 61, 10, 30}), std::invalid_argument);
  solver.uncover(0);
  solver.advance_to(0.35);
  EXPECT_LT(solver.at(35, 20).h, 0.2);
}

// Nothing imposed: no mass passes; the zone is dry inside, so what runs in a skipped block is woken by the rim.
TEST(Zone, RimFeedsADryDomain) {
  SolverSettings s = basin(64, 8, 0.05);
  Solver solver(s, ReferenceSurface::flat(3.2), {});
  solver.cover({0, 32, 0, 8});
  for (int k = 0; k < 8; ++k) solver.impose(0, SideName::downstream, k, flux_x(0.1, 1, 0, 9.81));
  for (int k = 0; k < 100; ++k) solver.step(0.005);
  EXPECT_NEAR(solver.volume(), 0.1 * 1 * solver.time() * 0.4, 1e-14);
  EXPECT_EQ(solver.passed(0, SideName::upstream, 0).mass, 0);
}

}  // namespace
}  // namespace couloir::test
