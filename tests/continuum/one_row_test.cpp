// One row of cells is the 1D model (2.2), (2.11): a flow that is the same all across has its bits in every row.

#include <gtest/gtest.h>

#include "bodies.hpp"
#include "continuum/noc/noc_solver.hpp"
#include "scenes.hpp"

namespace couloir::test {
namespace {

constexpr double dy = 1.0 / 32;

// Quartz down a chute, pushed at the start so that it stretches and is compressed.
SolverSettings settings(int rows, Side::Kind across) {
  SolverSettings s;
  s.grid = {80, rows, 1.0 / 64, dy, 0, -0.5 * rows * dy};
  s.closure = quartz();
  s.sides = sides(Side::Kind::outflow, across);
  s.sides[0].kind = Side::Kind::inflow;
  s.sides[0].depth = 0.03, s.sides[0].velocity = 1;
  s.block = 16;
  return s;
}

ReferenceSurface chute() {
  return ReferenceSurface::chute(degrees(35), 0.65, 0.3, 0.3);
}

void release(FlowModel& flow) {
  flow.set([](double x, double) {
    const double a = (x - 0.3) / 0.2, h = a * a < 1 ? 0.12 * (1 - a * a) : 0.0;
    return FlowState{h, (1 + a) * h, 0};
  });
}

// Elevation and step reach over the whole width.
StepBed obstacles(const Grid& g, bool relief) {
  StepBed bed;
  bed.obstacles.push_back({"sill", 0.9, 0.95, -1, 1, 0.03});
  if (!relief) return bed;
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) bed.elevation.push_back(std::max(0.0, 0.03 - std::abs(g.x(i) - 0.6) / 3));
  }
  bed.owner.assign(bed.elevation.size(), -1);
  return bed;
}

void expect_one_row(FlowModel& one, FlowModel& many) {
  release(one), release(many);
  one.advance_to(0.6), many.advance_to(0.6);
  EXPECT_EQ(one.steps(), many.steps());
  EXPECT_GT(one.steps(), 50);
  EXPECT_GT(one.max_speed(), 0.5);
  const Grid& g = many.grid();
  for (int i = 0; i < g.nx; ++i) {
    const FlowState a = one.at(i, 0);
    EXPECT_EQ(a.hv, 0);
    for (int j = 0; j < g.ny; ++j) {
      const FlowState b = many.at(i, j);
      ASSERT_EQ(a.h, b.h) << i << " " << j;
      ASSERT_EQ(a.hu, b.hu) << i << " " << j;
      ASSERT_EQ(b.hv, 0) << i << " " << j;
    }
  }
}

class OneRow : public testing::TestWithParam<Side::Kind> {};

TEST_P(OneRow, CentralUpwindHasTheBitsOfEveryRow) {
  for (const bool relief : {false, true}) {
    const SolverSettings row = settings(1, GetParam()), field = settings(24, GetParam());
    Solver one(row, chute(), obstacles(row.grid, relief)), many(field, chute(), obstacles(field.grid, relief));
    expect_one_row(one, many);
    EXPECT_NEAR(24 * one.obstacle_impulse(0)[0], many.obstacle_impulse(0)[0], 1e-14 * many.obstacle_impulse(0)[0]);
    EXPECT_GT(one.obstacle_impulse(0)[0], 0);
  }
}

TEST_P(OneRow, NocHasTheBitsOfEveryRow) {
  NocBed bed;
  bed.obstacles.push_back([](double x, double) { return std::max(0.0, 0.03 - std::abs(x - 0.6) / 3); });
  NocSolver one(settings(1, GetParam()), chute(), bed), many(settings(24, GetParam()), chute(), bed);
  expect_one_row(one, many);
}

INSTANTIATE_TEST_SUITE_P(
    Of, OneRow, testing::Values(Side::Kind::wall, Side::Kind::periodic, Side::Kind::outflow), [](const auto& info) {
      return std::string(info.param == Side::Kind::wall ? "walls" : info.param == Side::Kind::periodic ? "periodic" : "outflow");
    });

}  // namespace
}  // namespace couloir::test
