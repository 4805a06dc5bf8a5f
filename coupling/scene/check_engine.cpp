#include "coupling/scene/check_engine.hpp"

#include <fmt/format.h>

#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

void check_ranks(const Scene& scene) {
  if (scene.grains.engine != "yade" || scene.grains.ranks == 1) return;
  throw SceneError(fmt::format("{}: grains.ranks is {}, but yade runs on one rank; leave it out, or use grains.engine: liggghts",
                               scene.places.of("grains.ranks"), scene.grains.ranks));
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
  check_rotation(scene);
}

}  // namespace couloir
