#include "coupling/scene/depths.hpp"

#include <algorithm>

#include "coupling/scene/inflow.hpp"
#include "coupling/scene/release_shape.hpp"

namespace couloir {

double greatest_depth(const Scene& scene) {
  double depth = deepest(scene);
  for (const SideSpec& side : scene.sides) depth = std::max(depth, greatest_inflow(scene, side).depth);
  return depth;
}

double dry_depth(const Scene& scene) {
  return 1e-6 * greatest_depth(scene);
}

double thin_depth(const Scene& scene) {
  return 1e-5 * greatest_depth(scene);
}

double arrival_depth(const Scene& scene) {
  return 0.01 * greatest_depth(scene);
}

}  // namespace couloir
