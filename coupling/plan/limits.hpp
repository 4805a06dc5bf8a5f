#pragma once
// What a scene may not ask of the engine or of the machine.

#include "coupling/plan/plan.hpp"

namespace couloir {

// The engine's step at most a quarter longer than the stable one; in a coupling window the flow at most half the driven layer on;
// a zone on cell lines that cuts no obstacle; at most 1e9 grains. Throws SceneError with place, key, bound and remedy.
void check_limits(const Scene&, const Plan&);

// Throws SceneError where the plan needs more memory than this machine has; each of the ranks that share the continuum holds all.
void check_memory(const Scene&, const Plan&, int ranks = 1);

double machine_memory();  // [bytes]

}  // namespace couloir
