// The procedure on grains of a closed law: what it finds is known.
#include "coupling/calibration/calibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace couloir;

namespace {

// tan(phi) = 0.2 + 0.3 friction + 0.2 rolling / (rolling + 0.2); delta = base friction up to what the grains hold.
std::vector<SlabCurve> closed_law(const std::vector<SlabSpec>& slabs) {
  std::vector<SlabCurve> curves;
  for (const SlabSpec& s : slabs) {
    const double phi = 0.2 + 0.3 * s.friction + 0.2 * s.rolling_friction / (s.rolling_friction + 0.2);
    SlabCurve c;
    c.engine = "closed";
    for (int k = 0; k < 6; ++k) {
      SlabPoint p;
      p.inertia = 0.02 + 0.01 * k;
      p.friction = s.base == SlabBase::rough ? phi + 0.4 * p.inertia : std::min(s.base_friction, 0.9 * phi);
      c.points.push_back(p);
    }
    curves.push_back(c);
  }
  return curves;
}

CalibrationRecord found(double delta, double phi) {
  CalibrationTask task;
  task.material = "closed";
  task.delta = std::atan(delta);
  task.phi = std::atan(phi);
  task.stock.diameter = 0.004;
  task.plan = SlabPlan::full(2);
  return calibrate(task, closed_law, [](const std::string&) {});
}

double tangent(double degrees) {
  return std::tan(degrees * M_PI / 180);
}

}  // namespace

TEST(Calibrate, FindsFrictionAloneWhereThatIsEnough) {
  const CalibrationRecord r = found(0.4, 0.5);
  EXPECT_TRUE(r.phi.met);
  EXPECT_TRUE(r.delta.met);
  EXPECT_NEAR(tangent(r.phi.reached), 0.5, 0.01);
  EXPECT_NEAR(tangent(r.delta.reached), 0.4, 0.003);
  EXPECT_EQ(r.grains.rolling_friction, 0.15);
  EXPECT_NEAR(0.2 + 0.3 * r.grains.friction + 0.2 * 0.15 / 0.35, 0.5, 0.01);
  EXPECT_NEAR(r.phi_slope, 0.4, 1e-9);
  EXPECT_TRUE(r.notes.empty()) << r.notes.front();
}

TEST(Calibrate, RaisesRollingFrictionWhereFrictionDoesNotSuffice) {
  const CalibrationRecord r = found(0.4, 0.64);
  EXPECT_TRUE(r.phi.met);
  EXPECT_EQ(r.grains.friction, 1);
  EXPECT_GT(r.grains.rolling_friction, 0.2);
  EXPECT_NEAR(tangent(r.phi.reached), 0.64, 0.01);
}

TEST(Calibrate, SaysWhatIsOutOfReach) {
  const CalibrationRecord r = found(0.7, 0.9);
  EXPECT_FALSE(r.phi.met);
  EXPECT_FALSE(r.delta.met);
  EXPECT_EQ(r.grains.friction, 1);
  EXPECT_EQ(r.grains.rolling_friction, 1);
  EXPECT_NEAR(tangent(r.phi.reached), 0.5 + 0.2 / 1.2, 1e-6);
  EXPECT_NEAR(tangent(r.delta.reached), 0.9 * (0.5 + 0.2 / 1.2), 1e-6);
  ASSERT_EQ(r.notes.size(), 2u);
  EXPECT_NE(r.notes[0].find("phi of 42.0 deg is out of reach"), std::string::npos) << r.notes[0];
  EXPECT_NE(r.notes[1].find("delta of 35.0 deg is out of reach"), std::string::npos) << r.notes[1];
}

TEST(Calibrate, TheSameTwiceIsTheSameRecord) {
  EXPECT_EQ(write_calibration(found(0.4, 0.5)), write_calibration(found(0.4, 0.5)));
}
