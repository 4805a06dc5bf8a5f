// Mass and momentum over slope and planes.

#include <gtest/gtest.h>

#include "plane_scenes.hpp"

namespace couloir {
namespace {

using namespace test;

TEST(PlanesConservation, MassOverSlopeAndPlanesIsKeptToRoundOff) {
  for (double eta : {0.3, 0.8, 1.0}) {
    PlanesModel model = dam({.eta = eta});
    const double start = model.volume();
    double on_front = 0;
    for (double t = 0.1; t < 0.95; t += 0.1) {
      model.advance_to(t);
      EXPECT_NEAR(model.volume() - model.budget().mass_boundary, start, 1e-13 * start) << "eta " << eta << ", t " << t;
      on_front = std::max(on_front, model.plane(PlaneName::front).volume());
    }
    EXPECT_EQ(model.budget().mass_clipped, 0);
    EXPECT_GE(model.min_depth(), 0);
    EXPECT_GT(on_front, 0.005 * start) << "eta " << eta;
  }
}

// What slope and planes have gained is what gravity, friction, sides and obstacle gave.
TEST(PlanesConservation, MomentumBudgetCloses) {
  for (double skew : {0.0, 0.05}) {
    PlanesModel model = dam({.eta = 0.9, .skew = skew});
    model.advance_to(0.6);
    EXPECT_GT(model.overflow(), 0) << "the top plane has its share";
    const Budget& b = model.budget();
    const auto now = model.momentum();
    for (int k : {0, 1}) {
      const double gained = b.gravity[k] + b.friction[k] + b.boundary[k] + b.obstacles[k] + b.cutoff[k];
      EXPECT_NEAR(now[k], gained, 1e-12 * b.gravity[0]) << "component " << k << ", skew " << skew;
      EXPECT_EQ(b.zone[k], 0);
    }
  }
}

// From around, over slope and planes: what the budget's obstacles took. The rest of it is the turning about convex edges.
TEST(PlanesConservation, ControlVolumeSeesSlopeAndPlanes) {
  PlanesModel model = dam({.eta = 0.9, .skew = 0.05});
  const CellBox& own = model.footprint();
  model.advance_to(0.3);
  model.reset_budget();
  const auto before = model.obstacle_impulse(0);
  const int round = model.add_control_box({own.i0 - 2, own.i1 + 2, own.j0 - 2, own.j1 + 2});
  const int above = model.add_control_box({own.i0 - 20, own.i0 - 10, own.j0, own.j1});
  PlanesModel again = dam({.eta = 0.9, .skew = 0.05});
  again.restore(model.checkpoint());
  for (PlanesModel* m : {&model, &again}) m->advance_to(0.6);
  const auto seen = model.control_box_impulse(round);
  EXPECT_GT(model.overflow(), 0);
  for (int k : {0, 1}) {
    EXPECT_NEAR(seen[k], -model.budget().obstacles[k], 1e-12 * seen[0]) << "component " << k;
    EXPECT_NEAR(model.control_box_impulse(above)[k], 0, 1e-12 * seen[0]) << "no body there";
  }
  EXPECT_GT(seen[0], 0.5 * (model.obstacle_impulse(0)[0] - before[0]));
  EXPECT_EQ(seen, again.control_box_impulse(round));
}

// Where material is shed beside a plane's foot that is empty, sums of what comes and goes leave no round-off there to be drawn.
TEST(PlanesConservation, AnEmptyPlaneBesideShedMaterialIsNotOverdrawn) {
  PlanesModel model = dam({.cell = unit / 10, .eta = 0.9});
  EXPECT_NO_THROW(model.advance_to(0.34));
  EXPECT_GT(model.plane(PlaneName::left).volume(), 0);
}

// Across the whole domain nothing turns about an upright edge: then the obstacle's force is all that the budget's obstacles took.
TEST(PlanesConservation, ForceIsTheBudgetsWhereNoConvexEdgeTurnsTheFlow) {
  Dam d{.eta = 0.6, .height = 12 * unit};
  d.whole_width = true;
  PlanesModel model = dam(d);
  const CellBox& own = model.footprint();
  const int round = model.add_control_box({own.i0 - 2, own.i1 + 2, own.j0, own.j1});
  model.advance_to(0.6);
  ASSERT_EQ(model.overflow(), 0);
  EXPECT_GT(model.plane(PlaneName::front).volume(), 0);
  EXPECT_NEAR(model.obstacle_impulse(0)[0], -model.budget().obstacles[0], 1e-12 * model.obstacle_impulse(0)[0]);
  EXPECT_NEAR(model.control_box_impulse(round)[0], model.obstacle_impulse(0)[0], 1e-12 * model.obstacle_impulse(0)[0]);
  EXPECT_NEAR(model.obstacle_impulse(0)[1], 0, 1e-12 * model.obstacle_impulse(0)[0]);
}

}  // namespace
}  // namespace couloir
