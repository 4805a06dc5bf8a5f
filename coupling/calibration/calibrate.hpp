#pragma once
// Grain parameters that show a material's phi and delta.
//
//   phi     rough base: friction between grains, at most 1, with the default rolling friction; where that is not enough, friction
//   1
//           and rolling friction up to 1
//   delta   flat base, of those grains: base friction with the default base rolling friction; where lone grains roll away under
//           it, base rolling friction as between grains
//
// phi does not depend on the friction of the flat base, and delta is searched with the grains that phi asks for: one round is
// enough.

#include <functional>
#include <string>

#include "coupling/calibration/measurements.hpp"
#include "coupling/calibration/record.hpp"

namespace couloir {

struct CalibrationTask {
  std::string material, source;  // name, and where its angles come from
  double delta = 0, phi = 0;     // [rad] measured
  PackingSpec stock;             // diameter, spread, density, restitution, stiffness, contact law, rotation
  SlabPlan plan;
  bool quick = false;  // coarser searches
};

// `measure`: the curves of slabs (Measurements::measure); `say`: a line for each step.
// Throws what `measure` throws.
CalibrationRecord calibrate(const CalibrationTask&,
                            const std::function<std::vector<SlabCurve>(const std::vector<SlabSpec>&)>& measure,
                            const std::function<void(const std::string&)>& say);

}  // namespace couloir
