#include "coupling/engine/rotation.hpp"

#include <stdexcept>

namespace couloir {

Rotation rotation(const std::string& name) {
  for (const Rotation r : {Rotation::free, Rotation::blocked, Rotation::control})
    if (name == to_string(r)) return r;
  throw std::invalid_argument("no rule of rotation is called " + name);
}

const char* to_string(Rotation r) {
  return r == Rotation::free ? "free" : r == Rotation::blocked ? "blocked" : "control";
}

}  // namespace couloir
