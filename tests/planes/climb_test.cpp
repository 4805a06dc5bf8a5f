// How high the flow climbs.

#include <gtest/gtest.h>

#include "continuum/solver.hpp"
#include "plane_scenes.hpp"

namespace couloir {
namespace {

using namespace test;

double greatest_climb(PlanesModel& model, double until, double least_depth) {
  double most = 0;
  while (model.time() < until) {
    model.step(until - model.time());
    most = std::max(most, model.climbed(least_depth));
  }
  return most;
}

// Height of the middle of all mass that is on the front [m].
double middle_of_front(const PlanesModel& model) {
  const PlaneFlow& front = model.plane(PlaneName::front);
  double mass = 0, moment = 0;
  for (int j = 0; j < front.grid().ny; ++j) {
    for (int i = 0; i < front.grid().nx; ++i) mass += front.at(i, j).h, moment += front.at(i, j).h * front.grid().x(i);
  }
  return mass > 0 ? moment / mass : 0;
}

// A thin sheet 0.1 m long at 3 m/s, on a slope from wall to wall, turns up the front. How high its middle rises, over the energy
// line eta^2 u^2 / (2 g (cos(zeta) + sin(zeta) tan(delta))). Its middle falls 0.07 m to the wall.
double over_energy_line(double eta, double zeta, double delta, double dx) {
  const double front = 0.4, u0 = 3, h = 0.05e-3, g = 9.81;
  SolverSettings s;
  s.grid = {static_cast<int>(std::lround(0.5 / dx)), 4, dx, dx, 0, -2 * dx};
  s.sides[2].kind = s.sides[3].kind = Side::Kind::wall;
  s.closure.tan_delta = std::tan(delta);
  StepBed bed;
  bed.obstacles.push_back({"wall", front, front + 0.05, -2 * dx, 2 * dx, 0.9});
  PlanesModel model(s, ReferenceSurface::incline(zeta, 0.5), bed, 0, eta);
  model.set([&](double x, double) {
    const bool here = x > 0.28 && x < 0.38;
    return FlowState{here ? h : 0.0, here ? h * u0 : 0.0, 0};
  });
  const double u2 = u0 * u0 + 2 * g * (std::sin(zeta) - std::cos(zeta) * s.closure.tan_delta) * 0.07;
  const double brake = g * (std::cos(zeta) + std::sin(zeta) * s.closure.tan_delta), line = eta * eta * u2 / (2 * brake);
  const double top = 0.02 + eta * u0 / brake;  // [s] when the middle turns back, about
  double most = 0;
  while (model.time() < 1.2 * top) {
    model.step(1.2 * top - model.time());
    if (model.time() > 0.5 * top) most = std::max(most, middle_of_front(model));
  }
  return most / line;
}

TEST(PlanesClimb, ThinSheetReachesTheEnergyLine) {
  for (double zeta : {degrees(5), degrees(40)}) {
    for (double eta : {0.5, 0.8, 1.0}) {
      for (double delta : {0.0, degrees(24)}) {
        const double got = over_energy_line(eta, zeta, delta, 0.005);
        EXPECT_NEAR(got, 1, 0.03) << "zeta " << zeta << ", eta " << eta << ", delta " << delta;
      }
    }
  }
}

TEST(PlanesClimb, NothingClimbsWithoutAShare) {
  PlanesModel model = dam({.eta = 0});
  const double start = model.volume();
  model.advance_to(0.6);
  for (PlaneName p : {PlaneName::front, PlaneName::back, PlaneName::left, PlaneName::right, PlaneName::top}) {
    EXPECT_EQ(model.plane(p).volume(), 0);
  }
  EXPECT_EQ(model.overflow(), 0);
  EXPECT_GT(model.heap(), unit) << "it is held before the wall";
  EXPECT_NEAR(model.volume() - model.budget().mass_boundary, start, 1e-13 * start);
}

// What slides along the sides leaves them behind: nothing clings round to the back, and a vacuum stays open there.
TEST(PlanesClimb, WithoutOverflowTheVacuumStaysOpen) {
  PlanesModel model = dam({.eta = 0.5, .height = 6 * unit});
  double on_sides = 0;
  const double start = model.volume();
  for (double t = 0.3; t < 0.65; t += 0.05) {
    model.advance_to(t);
    on_sides = std::max(on_sides, model.plane(PlaneName::left).volume());
    ASSERT_EQ(model.overflow(), 0);
    EXPECT_EQ(model.plane(PlaneName::back).volume(), 0);
    const CellBox box = model.footprint();
    const int middle = (box.j0 + box.j1) / 2;
    EXPECT_LT(model.at(box.i1 + 1, middle).h, 1e-7);
  }
  EXPECT_GT(on_sides, 1e-4 * start);
}

// With eta = 0 the cuboid is an endless wall, which a step of that height is too.
TEST(PlanesClimb, WithoutAShareTheForceIsThatOfAStep) {
  const Dam d{.eta = 0, .hydraulic = true};  // with a switched K the heap before a wall hangs on the least difference
  PlanesModel planes = dam(d);
  Solver step = tall_step(d);
  planes.advance_to(0.8);
  step.advance_to(0.8);
  EXPECT_NEAR(planes.obstacle_impulse(0)[0], step.obstacle_impulse(0)[0], 1e-4 * step.obstacle_impulse(0)[0]);
  EXPECT_NEAR(planes.heap(), step.at(planes.footprint().i0 - 1, planes.grid().ny / 2).h, 1e-3 * planes.heap());
}

TEST(PlanesClimb, GrowsWithTheShare) {
  double before = 0;
  for (double eta : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    PlanesModel model = dam({.eta = eta, .height = 8 * unit});
    const double climb = greatest_climb(model, 0.6, 0.02 * unit);
    if (eta > 0) {
      EXPECT_GT(climb, before) << "eta " << eta;
    }
    before = climb;
  }
}

}  // namespace
}  // namespace couloir
