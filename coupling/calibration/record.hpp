#pragma once
// What a calibration asked for and reached: a YAML file without a date, so that the same input gives the same bytes.

#include <array>
#include <string>
#include <vector>

#include "coupling/calibration/angles.hpp"

namespace couloir {

struct CalibratedAngle {
  double asked = 0, reached = 0, uncertainty = 0;  // [deg]
  bool met = false;                                // within the uncertainty, or the search's tolerance where that is larger
};

struct CalibrationRecord {
  std::string material, source;                                   // source: of the angles asked for
  std::string engine, contact, rotation;                          // engine: name and version
  double diameter = 0, spread = 0, density = 0;                   // [m], [-], [kg/m3] of a grain
  double restitution = 0, youngs_modulus = 0, poisson_ratio = 0;  // [-], [Pa], [-]
  std::vector<double> seeds;
  double slab_length = 0, slab_width = 0;  // [d]
  TriedGrains grains;                      // found
  CalibratedAngle delta, phi;
  double delta_depth_change = 0, delta_speed_change = 0;  // [deg] of the deepest less the shallowest, fastest less slowest slab
  double phi_incline = 0;                                 // [deg] of the rough base
  double phi_slope = 0;                                   // [-] of mu against I
  double phi_by_sine = 0;          // [deg] were mu its sine: the angle of a Mohr circle on whose shear plane mu acts (Davis 1968)
  double phi_deep = 0;             // [deg] of the deeper slab; 0: none looked at
  std::vector<std::string> notes;  // what did not come out as asked

  // Numbers as tables, rows of equal length.
  std::vector<std::array<double, 3>> phi_search;    // friction, rolling friction, tan(phi)
  std::vector<std::array<double, 3>> delta_search;  // base friction, base rolling friction, tan(delta)
  std::vector<std::array<double, 5>> delta_slabs;   // depth [d], speed [sqrt(g d)], seed, mu, slip
  std::vector<std::array<double, 4>> phi_slabs;     // depth [d], replicate, I, mu
  std::vector<std::array<double, 4>> base_curve;    // friction, rolling friction of the grains; base friction, mu
};

std::string write_calibration(const CalibrationRecord&);

// Throws SceneError, with the place, where the text is no record. `name` goes before line numbers.
CalibrationRecord read_calibration(const std::string& text, const std::string& name);

}  // namespace couloir
