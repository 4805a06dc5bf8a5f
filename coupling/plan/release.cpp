#include "coupling/plan/release.hpp"

#include "coupling/scene/release_shape.hpp"

namespace couloir {

FlowState release_at(const Scene& scene, double x, double y) {
  const double h = depth_scale(scene) * shape_depth(scene, x, y);
  return {h, h * scene.release.velocity, h * scene.release.velocity_across};
}

double release_volume(const Scene& scene) {
  return scene.release.mass > 0 ? scene.release.mass / scene.material.density : shape_volume(scene);
}

bool inside_release(const Scene& scene, double x, double y, double n) {
  return n >= 0 && n < release_at(scene, x, y).h;
}

}  // namespace couloir
