#pragma once
#include <string>

namespace couloir {

// A word as a shell takes it; in quotes where it needs them.
std::string for_shell(const std::string& word);

}  // namespace couloir
