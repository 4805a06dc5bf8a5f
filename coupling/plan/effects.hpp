#pragma once
#include <vector>

#include "coupling/plan/effect.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// Every effect that the platform knows, on or off for this scene, and why.
std::vector<Effect> effects_of(const Scene&);

// As if the scene switched none off by hand.
std::vector<Effect> called_for(const Scene&);

}  // namespace couloir
