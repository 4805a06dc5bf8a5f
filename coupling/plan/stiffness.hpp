#pragma once
// How stiff the scene's grains are, how far impacts press them into each other, and the step that this allows the engine.

#include "coupling/engine/contact_law.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// [m/s] at which grains are expected to meet what stands in their way: release, inflows, and the expected flow with its waves,
// u + sqrt(g h), as far as the last obstacle or the scene's last zone; without either down to the terrain's end. The same in all
// modes, so that their grains can be compared: what grains alone do beyond is left out.
double impact_speed(const Scene&);

// [d] by which two of the scene's grains that meet at `speed` [m/s] overlap, by Hertz:
// (5 pi sqrt(2) / 8 rho v^2 / E*)^0.4 / 2. Source: Johnson, Contact Mechanics, eq. 11.25, for equal spheres.
double impact_overlap(const Scene&, double speed);

// [d] that grains in a bunch overlap by at most where its front is stopped: half as much again as two alone. A column of touching
// spheres that runs into a wall has a compaction front of overlap (pi/4 rho v^2 / E*)^0.4, 1.21 times that of two alone, and its
// chain of grains swings beyond; random small scenes have shown up to 1.54.
double bunch_overlap(const Scene&, double speed);

// [Pa] the scene's own; or the least of 5, 7, 10, 14, 20, 28, 40 MPa and so on at which a bunch at impact_speed() overlaps by no
// more than a tenth of a diameter.
double youngs_modulus(const Scene&);

GrainStiffness grain_stiffness(const Scene&, double grain_density);

// [s] the engine's stable step for the scene's smallest grain; the scene's own step, or where it gives none the stable one.
double stable_timestep(const Scene&, double grain_density);
double engine_timestep(const Scene&, double grain_density);

}  // namespace couloir
