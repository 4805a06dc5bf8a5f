#pragma once
#include <string>
#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

inline std::vector<std::string> obstacle_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const ObstacleSpec& o : scene.obstacles) names.push_back(o.name);
  return names;
}

}  // namespace couloir
