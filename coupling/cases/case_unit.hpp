#pragma once
// Units of what is expected and asked for, and the dimension that a summary's quantity has by its name.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace couloir {

// A unit is a number times a unit's name: "N", "33.33 mm", "%". Values are multiples of it.
struct CaseUnit {
  std::string text;      // as written; empty: a plain number
  std::string quantity;  // "a force"; empty: any
  double si = 1;         // one of it in SI
};

// "N", "33.33 mm", "%", "". Throws std::invalid_argument; what() goes on from the key's name.
CaseUnit parse_case_unit(std::string_view text);

// "4170 N" -> 4170 and the unit N; "12" -> 12 and no unit. Throws as above.
std::pair<double, CaseUnit> parse_case_value(std::string_view text);

// "N", "kN" of "a force".
std::vector<std::string> units_of_quantity(std::string_view quantity);

// "a force" for obstacles.wall.force_peak; empty where the name does not tell.
std::string quantity_of_path(std::string_view path);

// A value in this unit: "5.387 N", "2 x 33.33 mm"; "-" where there is none.
std::string with_unit(double value, const CaseUnit&);

}  // namespace couloir
