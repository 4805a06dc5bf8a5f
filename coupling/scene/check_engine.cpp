#include "coupling/scene/check_engine.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

void check_ranks(const Scene& scene) {
  if (scene.grains.engine != "yade" || scene.grains.ranks == 1) return;
  throw SceneError(fmt::format("{}: grains.ranks is {}, but yade runs on one rank; leave it out, or use grains.engine: liggghts",
                               scene.places.of("grains.ranks"), scene.grains.ranks));
}

// Without tension a contact of a restitution of 0.21 damps as much as one of 0.05 with it, and LIGGGHTS, which settles the
// packings of both engines, takes no less (restitution_with_tension).
constexpr double least_undamped_restitution = 0.22;

void check_restitution(const Scene& scene) {
  const double e = scene.material.grain.restitution;
  if (scene.grains.tangential_damping || scene.grains.contact != "hertz" || e >= least_undamped_restitution) return;
  throw SceneError(
      fmt::format("{}: grains.tangential_damping is off where the restitution is {:g}: packings of both engines are settled by "
                  "LIGGGHTS, whose hertz then takes no less than {:g}; raise the restitution, leave tangential_damping out, or "
                  "use grains.contact: kelvin_voigt",
                  scene.places.of("grains.tangential_damping"), e, least_undamped_restitution));
}

void check_seeds(const Scene& scene) {
  const long most = std::numeric_limits<std::int32_t>::max() - (scene.grains.replicates - 1);
  if (scene.grains.seed <= most) return;
  throw SceneError(
      fmt::format("{}: grains.seed is {}, but {} packings have seeds from it upward, up to {} at most; lower it to {} or less",
                  scene.places.of("grains.seed"), scene.grains.seed, scene.grains.replicates,
                  std::numeric_limits<std::int32_t>::max(), most));
}

void check_rotation(const Scene& scene) {
  const RotationSpec& c = scene.grains.control;
  if (scene.grains.rotation != "control" || c.roll_to_slide <= c.slide_to_roll) return;
  const std::string key = "grains.rotation.control.roll_to_slide";
  throw SceneError(fmt::format(
      "{}: {} is {}, above slide_to_roll, {}: a grain would stop its spin and start it again at once; lower it, or raise "
      "slide_to_roll",
      scene.places.of(key), key, short_quantity(c.roll_to_slide, Dimension::velocity),
      short_quantity(c.slide_to_roll, Dimension::velocity)));
}

}  // namespace

void check_engine(const Scene& scene) {
  if (scene.mode == Mode::continuum) return;
  check_ranks(scene);
  check_seeds(scene);
  check_rotation(scene);
  check_restitution(scene);
}

}  // namespace couloir
