#pragma once
#include <string>

namespace couloir {

// One physical or numerical effect: simulated or not, and why.
struct Effect {
  std::string name;
  bool on = false;
  std::string reason;
};

}  // namespace couloir
