#pragma once
#include "coupling/scene/scene.hpp"

namespace couloir {

// The scene's own boxes of grains lie in the domain, leave room for their layers and around the obstacles that they hold, keep
// clear of each other, and hold some obstacle where there is one. Throws SceneError.
void check_zones(const Scene&);

}  // namespace couloir
