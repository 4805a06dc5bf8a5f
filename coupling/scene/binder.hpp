#pragma once
// Node -> Scene by the schema: refuses what the schema does not know, reads what it does, remembers where it stood.

#include "coupling/scene/node.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// Fills `scene`, which holds the defaults. Notes in scene.places where keys stood. Throws SceneError with place, key and remedy.
void bind(const Node& document, Scene& scene);

}  // namespace couloir
