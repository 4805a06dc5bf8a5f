#pragma once
#include <vector>

#include "coupling/plan/effect.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// Every effect that the platform knows, on or off for this scene, and why.
std::vector<Effect> effects_of(const Scene&);

}  // namespace couloir
