#pragma once
// What comes in through an inflow side, in numbers.

#include <string>
#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

// Flow from a silo's gate [m/s]: velocity = q / gate with the discharge a metre of width q = 1.03 sqrt(g) (gate - 1.4 d)^1.5,
// Beverloo's law for a slot, d the mean grain diameter of the material. An assumption: of the silo of Chiou (2006) neither
// discharge nor velocity is documented, only the gate's openings of 3 to 18 mm (section 4.1 of the dissertation). Validity: gates
// of more than about 4 d. 0 where the gate is too narrow. d = 0 is for material that is only known to be fine: an upper bound.
double silo_velocity(double gate, double diameter, double gravity);

// The greatest depth [m] and the greatest velocity [m/s] that an inflow side ever has.
struct GreatestInflow {
  double depth = 0, velocity = 0;
};
GreatestInflow greatest_inflow(const Scene&, const SideSpec&);

// What is assumed of inflows for want of a key, a sentence each: the rate of a silo whose material has no diameter.
std::vector<std::string> inflow_assumptions(const Scene&);

// [m3] a metre of the side, over the whole run.
double inflow_volume(const Scene&, const SideSpec&);

}  // namespace couloir
