#include "coupling/calibration/material_file.hpp"

#include <gtest/gtest.h>

using namespace couloir;

namespace {

CalibrationRecord found() {
  CalibrationRecord r;
  r.diameter = 0.005;
  r.youngs_modulus = 5e6;
  r.grains = {1, 0.4, 0.53, 0.15};
  r.delta = {28, 27.96, 0.12, true};
  r.phi = {40, 32.5, 0.3, false};
  return r;
}

const char* const before = R"(# Of the quarry.
name: quartz
density: 1639 kg/m3
source: 'Table 4.1: quartz. Grain parameters: not calibrated; base friction set to tan(delta).'
# Not calibrated.
grains:
  base_friction: 0.53171
  restitution: 0.6
  # of the wall
  wall_friction: 0.4
)";

const char* const after = R"(# Of the quarry.
name: quartz
density: 1639 kg/m3
source: 'Table 4.1: quartz.'
calibration: quartz-liggghts-5mm
# Grains of 5 mm show delta 28.0 +- 0.1 deg of 28.0 deg, phi 32.5 +- 0.3 deg of 40.0 deg.
grains:
  friction: 1
  rolling_friction: 0.4
  base_friction: 0.53
  base_rolling_friction: 0.15
  youngs_modulus: 5 MPa
  restitution: 0.6
  # of the wall
  wall_friction: 0.4
)";

}  // namespace

TEST(MaterialFile, TakesTheFoundFrictionsAndKeepsTheRest) {
  EXPECT_EQ(with_calibration(before, found(), "quartz-liggghts-5mm"), after);
}

TEST(MaterialFile, ASecondCalibrationReplacesTheFirst) {
  EXPECT_EQ(with_calibration(after, found(), "quartz-liggghts-5mm"), after);
  EXPECT_EQ(with_calibration("name: mud\n", found(), "mud-a").rfind("name: mud\ncalibration: mud-a\n", 0), 0u);
}
