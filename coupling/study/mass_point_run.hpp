#pragma once
#include <nlohmann/json.hpp>

#include "coupling/scene/scene.hpp"

namespace couloir {

// The cheapest rung of a ladder: summary.json of this scene by the mass point and the impact formula (coupling/plan/impact.hpp),
// in milliseconds. What they tell nothing about is null: impulses, forces after the impact, speeds across the slope.
nlohmann::json mass_point_summary(const Scene&);

}  // namespace couloir
