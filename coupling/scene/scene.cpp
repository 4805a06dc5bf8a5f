#include "coupling/scene/scene.hpp"

namespace couloir {

const char* to_string(Mode mode) {
  switch (mode) {
    case Mode::continuum:
      return "continuum";
    case Mode::coupled:
      return "coupled";
    case Mode::grains:
      return "grains";
  }
  return "?";
}

}  // namespace couloir
