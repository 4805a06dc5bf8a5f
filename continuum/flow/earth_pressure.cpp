#include "continuum/flow/earth_pressure.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace couloir {
namespace {

// (2.83); sign -1: active, +1: passive.
double downslope(double phi, double delta, double sign) {
  const double ratio = std::cos(phi) / std::cos(delta);
  const double root = std::sqrt(std::max(0.0, 1 - ratio * ratio));
  return 2 * (1 + sign * root) / (std::cos(phi) * std::cos(phi)) - 1;
}

// (2.84): the principal stresses of [[K_x, tan delta], [tan delta, 1]].
double across(double kx, double delta, double sign) {
  const double t = std::tan(delta);
  return 0.5 * (kx + 1 + sign * std::sqrt((kx - 1) * (kx - 1) + 4 * t * t));
}

}  // namespace

EarthPressure EarthPressure::active_passive(double phi, double delta) {
  const double right_angle = 2 * std::atan(1.0);
  if (!(delta >= 0 && delta <= phi && phi < right_angle)) {
    std::ostringstream text;
    text << "The earth pressure coefficients need 0 <= delta <= phi < 90 deg, but phi = " << phi << " rad and delta = " << delta
         << " rad; correct the material's angles.";
    throw std::invalid_argument(text.str());
  }
  EarthPressure k;
  k.x_active = downslope(phi, delta, -1);
  k.x_passive = downslope(phi, delta, +1);
  k.y_active_active = across(k.x_active, delta, -1);
  k.y_passive_active = across(k.x_active, delta, +1);
  k.y_active_passive = across(k.x_passive, delta, -1);
  k.y_passive_passive = across(k.x_passive, delta, +1);
  return k;
}

}  // namespace couloir
