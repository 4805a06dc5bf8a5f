#pragma once
// Findings as lines, as a table, and as JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "coupling/check/verdict.hpp"

namespace couloir {

// "pass  chiou_wall, continuum: obstacles.wall.force_peak = 5.387 N, expected 5.387 N (+0.01 %, allowed 1 %)"
std::string finding_line(const Finding&);
// All of them in columns, under a line for each case; what was skipped only as numbers, and the counts below.
std::string findings_table(const std::vector<Finding>&);
nlohmann::ordered_json findings_json(const std::vector<Finding>&);

}  // namespace couloir
