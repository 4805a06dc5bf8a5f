#pragma once
#include <stdexcept>

namespace couloir {

// The user stopped the run before its first window.
struct Interrupted : std::runtime_error {
  Interrupted()
      : std::runtime_error("stopped by the user while the packing settled, before the start; nothing was computed yet") {}
};

}  // namespace couloir
