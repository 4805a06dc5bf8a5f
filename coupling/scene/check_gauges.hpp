#pragma once
#include "coupling/scene/scene.hpp"

namespace couloir {

// Stress gauges lie within the upstream face of a cuboid, apart from one another, and hold a grain. Throws SceneError.
void check_stress_gauges(const Scene&);

}  // namespace couloir
