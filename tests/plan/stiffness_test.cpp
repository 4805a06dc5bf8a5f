#include "coupling/plan/stiffness.hpp"

#include <gtest/gtest.h>

#include "coupling/plan/flow_estimate.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

Scene own_material(Overrides more = {}) {
  more.insert(more.begin(), {{"material", "{density: 1400 kg/m3, internal_friction_angle: 35 deg, basal_friction_angle: 22 deg}"},
                             {"grains.diameter", "6 mm"}});
  return experiment("chiou_wall", more);
}

// Energy of the approach becomes that of two Hertzian springs: m v^2 / 4 = 8/15 E* sqrt(d/4) delta^(5/2) / ... solved here by
// hand for glass-like numbers: rho 2500, v 1 m/s, E 5 MPa, nu 0.25.
TEST(Stiffness, ImpactOverlapIsHertzs) {
  Scene scene = own_material({{"grains.youngs_modulus", "5 MPa"}});
  scene.material.density = 2500 * 0.57, scene.grains.diameter = 0.01;
  const double pi = 3.14159265358979, d = 0.01, mass = 2500 * pi / 6 * d * d * d, e = 5e6 / (2 * (1 - 0.0625));
  const double overlap = impact_overlap(scene, 1) * d;
  const double energy = 4.0 / 15 * 2 * e * std::sqrt(d / 4) * std::pow(overlap, 2.5);  // of the contact, R* = d/4
  EXPECT_NEAR(energy, 0.25 * mass, 1e-9 * mass);
}

TEST(Stiffness, IsTheLeastThatKeepsABunchWithinATenth) {
  for (const char* speed : {"0 m/s", "1 m/s", "3 m/s", "6 m/s", "12 m/s"}) {
    Scene scene = own_material({{"release.velocity", speed}});
    const double modulus = youngs_modulus(scene), at = impact_speed(scene);
    EXPECT_LE(bunch_overlap(scene, at), 0.1) << speed;
    if (modulus == 5e6) continue;
    scene.material.grain.youngs_modulus = modulus / 1.5;
    EXPECT_GT(bunch_overlap(scene, at), 0.1) << speed << ": " << modulus;
  }
  EXPECT_EQ(youngs_modulus(own_material({{"grains.youngs_modulus", "9 MPa"}})), 9e6);
  EXPECT_EQ(youngs_modulus(experiment("chiou_wall")), 5e6) << "that of its calibration";
  EXPECT_GT(youngs_modulus(experiment("chiou_wall", {{"grains.youngs_modulus", "auto"}, {"release.velocity", "3 m/s"}})), 5e6);
}

TEST(Stiffness, CountsTheFlowOnlyAsFarAsItsGrains) {
  const Scene near = own_material({{"obstacles.wall.position", "[450 mm, 0]"}}), far = own_material();
  EXPECT_LT(impact_speed(near), impact_speed(far));
  EXPECT_GT(impact_speed(far), flow_estimate_at(far, 0.65).velocity) << "its waves run ahead of it";
}

TEST(Stiffness, IsTheSameInAllModes) {
  const double coupled = youngs_modulus(own_material());
  EXPECT_EQ(youngs_modulus(own_material({{"mode", "grains"}})), coupled);
}

}  // namespace
}  // namespace couloir
