#pragma once
// The closures of one run: earth pressure (2.83)-(2.86), basal friction, curvature.

#include "continuum/flow/earth_pressure.hpp"

namespace couloir {

struct Closure {
  EarthPressure earth_pressure;  // hydraulic (K = 1) or active/passive
  double tan_delta = 0;          // Coulomb basal friction; 0: frictionless
  bool curvature = true;         // the term kappa u^2 in the friction; off where the surface has no arc
};

}  // namespace couloir
