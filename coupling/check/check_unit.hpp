#pragma once
// Units of expected values, and the dimension that a summary's quantity has by its name.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coupling/check/expected.hpp"

namespace couloir {

// "N", "33.33 mm", "%", "". Throws std::invalid_argument; what() goes on from the key's name.
CheckUnit parse_check_unit(std::string_view text);

// "4170 N" -> 4170 and the unit N; "12" -> 12 and no unit. Throws as above.
std::pair<double, CheckUnit> parse_check_value(std::string_view text);

// "N", "kN" of "a force".
std::vector<std::string> units_of_quantity(std::string_view quantity);

// "a force" for obstacles.wall.force_peak; empty where the name does not tell.
std::string quantity_of_path(std::string_view path);

}  // namespace couloir
