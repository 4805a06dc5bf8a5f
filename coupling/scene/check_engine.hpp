#pragma once
// What the reader cannot see in the keys of the grains' engine.

#include "coupling/scene/scene.hpp"

namespace couloir {

void check_engine(const Scene&);  // throws SceneError with place and remedy

}  // namespace couloir
