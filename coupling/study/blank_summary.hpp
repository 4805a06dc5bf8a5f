#pragma once
#include <nlohmann/json.hpp>

#include "coupling/scene/scene.hpp"

namespace couloir {

// The summary.json of a run of this scene that computed nothing: every number that one may have, so that a path can be checked
// before the run. A force by a control box is in it even where another obstacle will stand in the box.
nlohmann::json blank_summary(const Scene&);

}  // namespace couloir
