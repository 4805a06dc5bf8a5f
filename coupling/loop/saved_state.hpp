#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace couloir {

// Writes a state file whole or not at all (a temporary name, then a rename). Throws std::runtime_error.
void save_bytes(const std::string& folder, const std::string& name, const std::vector<std::uint8_t>& bytes);

}  // namespace couloir
