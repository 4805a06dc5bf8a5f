#pragma once
#include <string>

#include "coupling/cases/case_unit.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// What a bare number after `key` counts in this scene: SI, or its scales (2.47). No unit where the key is a plain number or none.
CaseUnit unit_of_bare(const std::string& key, const Scene&);

// The SI unit that a summary's quantity has by its name; of a ratio: "kg/s", "N" of "N s / s". No unit where the name does not
// tell.
CaseUnit unit_of_path(const std::string& path);

}  // namespace couloir
