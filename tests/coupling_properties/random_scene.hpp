#pragma once
// A small coupled scene drawn from a seed, as the text of its file: the same on every machine.

#include <cstdint>
#include <string>

namespace couloir {

std::string random_scene(std::uint64_t seed);

}  // namespace couloir
