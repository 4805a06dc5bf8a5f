#pragma once
// Numbers of a run's summary.json by their path.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace couloir {

// A number of summary.json in SI, or the ratio of two: "obstacles.wall.impulse / time.simulated". NaN where it is null.
// Throws SceneError where the summary has no such number, with the nearest name. `place` is where the path was written.
double summary_value(const nlohmann::json& summary, const std::string& path, const std::string& place);

}  // namespace couloir
