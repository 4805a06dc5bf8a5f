#pragma once
// What the reader cannot see in the keys of the mesh.

#include "coupling/scene/scene.hpp"

namespace couloir {

inline constexpr double most_cells = 2e7;  // of a mesh, all levels together

// Both throw SceneError with place and remedy.
void check_mesh(const Scene&);  // the coarsest cells
void check_refinement(
    const Scene&);  // continuum.block, refine and adapt; obstacles and release must have been checked(const Scene&);

}  // namespace couloir
