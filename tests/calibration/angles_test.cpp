#include "coupling/calibration/angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace couloir;

namespace {

PackingSpec stock() {
  PackingSpec s;
  s.diameter = 0.004;
  return s;
}

SlabCurve along(double mu, double slope, double from, double to) {
  SlabCurve c;
  for (int k = 0; k <= 10; ++k) {
    SlabPoint p;
    p.inertia = from + (to - from) * k / 10;
    p.friction = mu + slope * p.inertia;
    c.points.push_back(p);
  }
  return c;
}

}  // namespace

TEST(Angles, PhiIsWhereTheLineMeetsNoInertia) {
  const SlabPlan plan = SlabPlan::full(2);
  const PhiReading r = read_phi(
      plan, {along(0.58, 0.5, 0.08, 0.02), along(0.58, 0.5, 0.2, 0.1), along(0.62, 0.5, 0.08, 0.02), along(0.62, 0.5, 0.2, 0.1)});
  EXPECT_TRUE(r.low);
  EXPECT_NEAR(r.friction, 0.60, 1e-12);
  EXPECT_NEAR(r.slope, 0.5, 1e-12);
  EXPECT_NEAR(r.uncertainty, 0.04, 1e-12) << "twice the standard error of 0.58 and 0.62";
  EXPECT_EQ(r.points.size(), 44u);
}

TEST(Angles, SlabsThatRunAwayTellNoPhi) {
  const SlabPlan plan = SlabPlan::full(1);
  const PhiReading r = read_phi(plan, {along(0.5, 0, 0.5, 2), along(0.5, 0, 0.6, 3)});
  EXPECT_FALSE(r.low);
  EXPECT_NEAR(r.friction, 0.5, 1e-12);
  EXPECT_EQ(r.uncertainty, 0);
}

TEST(Angles, DeltaIsTheMeanAndItsChangesAreTold) {
  const SlabPlan plan = SlabPlan::full(2);
  const std::vector<SlabSpec> slabs = delta_slabs(plan, stock(), {}, 0.5);
  ASSERT_EQ(slabs.size(), 8u);
  std::vector<SlabCurve> curves;
  for (const SlabSpec& s : slabs) {  // 0.5, 0.02 more where deep, 0.01 less where fast, 0.004 by seed
    const double mu = 0.5 + (s.depth > 0.03 ? 0.02 : 0) - (s.speed > 1.5 ? 0.01 : 0) + (s.stock.seed == 20011 ? 0.002 : -0.002);
    curves.push_back(along(mu, 0, 0.1, 0.2));
  }
  const DeltaReading r = read_delta(plan, curves);
  EXPECT_NEAR(r.friction, 0.505, 1e-12);
  EXPECT_NEAR(r.depth_change, 0.02, 1e-12);
  EXPECT_NEAR(r.speed_change, -0.01, 1e-12);
  EXPECT_NEAR(r.uncertainty, 0.004, 1e-12);
  EXPECT_EQ(r.rows.size(), 8u);
}

TEST(Angles, NoTwoSlabsOfAPlanAreTheSame) {
  const SlabPlan plan = SlabPlan::full(3);
  std::set<std::string> said;
  for (const SlabSpec& s : delta_slabs(plan, stock(), {}, 0.5)) said.insert(describe(s));
  for (const SlabSpec& s : phi_slabs(plan, stock(), {}, 0.5, plan.phi_depth)) said.insert(describe(s));
  EXPECT_EQ(said.size(), 18u);
  // what a rough base does not have does not tell its slabs apart
  EXPECT_EQ(describe(phi_slabs(plan, stock(), {1, 0.4, 0.3, 0.1}, 0.5, 10).front()),
            describe(phi_slabs(plan, stock(), {1, 0.4, 0.6, 0.2}, 0.5, 10).front()));
}
