#pragma once
// The summary.json of two runs of one scene beside each other.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace couloir {

// "obstacles.wall.force_peak 12.3 for 6.15, and 2 more", the first run's before the second's; empty: they agree. Numbers alone,
// without those of every run's own: seconds of clock and processor, rates, costs, where it was resumed.
//
// Without a tolerance all of them must be there and the same. With one (a share of the largest figure of the same kind beside it:
// impulse_across by impulse) those are left out that only one has, as another build may know other figures; those that a rounding
// moves far: instants, residuals, counts of steps and cells; and with grains all but impulses and masses.
std::string summary_difference(const nlohmann::json& first, const nlohmann::json& second, std::optional<double> tolerance,
                               bool grains);

}  // namespace couloir
