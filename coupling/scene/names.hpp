#pragma once
// "did you mean": the nearest of some names.

#include <string>
#include <string_view>
#include <vector>

namespace couloir {

// Optimal string alignment distance: insertions, deletions, changes and swaps of neighbours, one each.
int edit_distance(std::string_view a, std::string_view b);

// The nearest name if it is near enough to be a slip of the pen (a third of the letters wrong, at least one); else empty.
std::string nearest_name(std::string_view given, const std::vector<std::string>& names);

// "; did you mean 'friction'?", or, if nothing is near, "; " + what + " a, b, c".
std::string suggestion(std::string_view given, const std::vector<std::string>& names, std::string_view what);

}  // namespace couloir
