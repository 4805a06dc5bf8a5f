#pragma once
// Obstacles of shape mesh: their triangles, from the scene or from STL files, and what follows from them.

#include <string>

#include "coupling/scene/scene.hpp"

namespace couloir {

// Fills vertices, faces, body, length, width and height of every such obstacle. `folder`: the scene file's, that files' names
// count from. Where the scene has the triangles itself no file is read. Throws SceneError with place, key and remedy where a file
// is missing or is no STL file, and where the triangles are not the surface of one body that stands on the bed.
void read_bodies(Scene&, const std::string& folder);

// [m] longest edge of the triangles that an engine is given.
inline double longest_edge(const GrainSpec& grains) {
  return 5 * grains.diameter;
}

}  // namespace couloir
