// 100 000 steps at rest and in motion.

#include "fixture.hpp"

namespace couloir::test {
namespace {

constexpr int many = 100000;

class Long : public Stability {
 protected:
  // Steps without looking, then looks every thousand.
  static void run_long(Demands& demands, FlowModel& solver) {
    for (int k = 0; k < many / 1000; ++k) {
      for (int n = 1; n < 1000; ++n) solver.step(solver.stable_dt());
      demands.step(solver.stable_dt());
    }
  }
};

// A heap that has come to rest beside a wall, with films around it: no bit changes.
TEST_P(Long, AtRestNothingCreeps) {
  Case c = plane(degrees(20), 24, 6, 0.05, 0.05);
  c.settings.closure = granular(38, 28);
  if (GetParam().has_steps) c.bed.obstacles.push_back({"wall", 0.8, 0.9, -0.05, 0.15, 0.5});  // noc never rests beside one
  c.fill([](double x, double y) {
    const double h = 1e-9 + heap(x - 0.5, y, 0.1, 0.2);
    return FlowState{h, 2 * h, 0};
  });
  const auto flow = c.build(GetParam());
  FlowModel& solver = *flow;
  Demands demands(c, GetParam(), solver);
  solver.advance_to(5);
  ASSERT_EQ(solver.max_speed(), 0);
  const Bits rest = bits_of(solver);
  const auto steps = solver.steps();
  run_long(demands, solver);
  EXPECT_GE(solver.steps() - steps, many);
  EXPECT_EQ(bits_of(solver), rest);
  demands.expect("");
}

// A frictionless basin that never stops sloshing.
TEST_P(Long, InMotionMassStays) {
  Case c = plane(0, 16, 4, 0.05, 0.05);
  c.bed.obstacles.push_back({"block", 0.3, 0.4, -0.05, 0.05, 0.3});
  c.fill([](double x, double y) { return FlowState{0.05 + (x > 0.5 ? 0.1 : 0.0) + (y > 0 ? 0.02 : 0.0), 0, 0}; });
  const auto flow = c.build(GetParam());
  FlowModel& solver = *flow;
  Demands demands(c, GetParam(), solver);
  run_long(demands, solver);
  EXPECT_EQ(solver.steps(), many);
  demands.expect("");
}

// A steady granular flow round a periodic slope, wet and dry.
TEST_P(Long, DownAPeriodicSlopeMassStays) {
  Case c = plane(degrees(30), 16, 4, 0.05, 0.05);
  c.settings.closure = granular(38, 30);
  c.settings.sides = sides(Side::Kind::periodic, Side::Kind::wall);
  c.fill([](double x, double) {
    const double h = x < 0.5 ? 0.05 : 0.0;
    return FlowState{h, 2 * h, 0.1 * h};
  });
  const auto flow = c.build(GetParam());
  FlowModel& solver = *flow;
  Demands demands(c, GetParam(), solver);
  run_long(demands, solver);
  EXPECT_GT(solver.max_speed(), 0.1);
  demands.expect("");
}

INSTANTIATE_TEST_SUITE_P(Of, Long, testing::ValuesIn(subjects()), subject_name);

}  // namespace
}  // namespace couloir::test
