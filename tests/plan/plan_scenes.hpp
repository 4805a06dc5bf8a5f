#pragma once
#include <string>

#include "coupling/scene/reader.hpp"

namespace couloir {

inline Scene experiment(const std::string& name, const Overrides& overrides = {}) {
  const std::string root = COULOIR_SOURCE_DIR;
  return read_scene(root + "/experiments/" + name, root + "/dem_inputs/materials", overrides);
}

}  // namespace couloir
