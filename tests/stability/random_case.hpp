#pragma once
// A scene drawn from a seed: the same on every machine.

#include <cstdint>

#include "case.hpp"

namespace couloir::test {

struct RandomCase {
  Case scene;
  int steps = 0;
  std::string words;  // what was drawn, for messages
};

RandomCase random_case(std::uint64_t seed);

}  // namespace couloir::test
