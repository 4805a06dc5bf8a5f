#pragma once
// Earth pressure coefficients K_x, K_y (2.83)-(2.86); all ones for the hydraulic closure.

namespace couloir {

// The strain from active to passive (scheme/mobilisation.hpp).
inline constexpr double passive_strain = 0.3;

struct EarthPressure {
  double x_active = 1, x_passive = 1;
  double y_active_active = 1, y_passive_active = 1;    // K_y for x active:  y active, y passive
  double y_active_passive = 1, y_passive_passive = 1;  // K_y for x passive: y active, y passive

  static EarthPressure hydraulic() { return {}; }
  // phi: internal friction angle [rad], delta: basal friction angle [rad]; needs 0 <= delta <= phi < 90 deg,
  // throws std::invalid_argument otherwise.
  static EarthPressure active_passive(double phi, double delta);

  bool is_hydraulic() const { return x_active == 1 && x_passive == 1; }
  double kx(double du_dx) const { return du_dx >= 0 ? x_active : x_passive; }
  double ky(double du_dx, double dv_dy) const {
    return du_dx >= 0 ? (dv_dy >= 0 ? y_active_active : y_passive_active) : (dv_dy >= 0 ? y_active_passive : y_passive_passive);
  }

  // Between active and passive: compression in x and y as a share in [0, 1] of what mobilises the passive state; 0 and 1 give
  // the values of kx, ky above.
  double kx_mobilised(double x) const { return (1 - x) * x_active + x * x_passive; }
  double ky_mobilised(double x, double y) const {
    return (1 - x) * ((1 - y) * y_active_active + y * y_passive_active) +
           x * ((1 - y) * y_active_passive + y * y_passive_passive);
  }

  // K answers strain: between the states its disturbances travel at sqrt((K + stiffness) g cos(zeta) h).
  double stiffness_x() const { return 0.5 / passive_strain * (x_passive - x_active); }
  double stiffness_y() const { return 0.5 / passive_strain * (y_passive_passive - y_active_passive); }
};

}  // namespace couloir
