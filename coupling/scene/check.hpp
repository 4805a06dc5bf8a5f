#pragma once
// The scene as a whole: do its parts fit each other?

#include "coupling/scene/scene.hpp"

namespace couloir {

// Throws SceneError naming place, key and remedy for the first thing that does not fit.
void check_scene(const Scene&);

}  // namespace couloir
