#include "coupling/plan/switches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "coupling/plan/effects.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

// Of the effects that are no terms: what to do instead.
const std::map<std::string, std::string>& remedies() {
  static const std::string obstacle = "take the obstacle out of obstacles, or give it another method";
  static const std::map<std::string, std::string> all{
      {"depth_averaged_flow", "use mode grains"},
      {"across_slope", "make terrain.width narrower than one and a half cells"},
      {"gravity_along_slope", "set terrain.angle to 0 deg"},
      {"steps_of_the_bed", obstacle},
      {"elevation", obstacle},
      {"planes", obstacle},
      {"solid_bodies", "take the obstacle out of obstacles"},
      {"inflow", "make the side a wall or an outflow in boundaries"},
      {"periodic_sides", "make the sides walls or outflows in boundaries"},
      {"grain_engine", "use mode continuum"},
      {"coupling", "use mode continuum or grains"},
  };
  return all;
}

}  // namespace

Scene as_run(const Scene& asked) {
  Scene scene = asked;
  if (asked.mode == Mode::grains) {  // an inflow's strip of cells is all that there may be of the continuum
    scene.continuum.scheme = ContinuumSpec().scheme;
    scene.continuum.limiter = ContinuumSpec().limiter;
    scene.continuum.refine.clear(), scene.continuum.adapt.levels = 0;
    scene.grains.follow = false;
  }
  if (asked.left_out.empty()) return scene;
  // What is off anyway must not be touched: even what nobody asks for may be a part of some key (a packing's name).
  scene.left_out.clear();
  for (const Effect& e : called_for(asked))
    if (e.on && asked.leaves_out(e.name)) scene.left_out.push_back(e.name);
  if (scene.leaves_out("refinement")) scene.continuum.refine.clear(), scene.continuum.adapt.levels = 0;
  if (scene.leaves_out("earth_pressure")) scene.continuum.closure = "hydraulic";
  if (scene.leaves_out("curvature")) scene.continuum.curvature = "off";
  GrainMaterial& grain = scene.material.grain;
  if (scene.leaves_out("basal_friction")) grain.base_friction = 0;
  if (scene.leaves_out("rolling_friction")) grain.rolling_friction = grain.base_rolling_friction = 0;
  if (scene.leaves_out("rotation_control")) scene.grains.rotation = "free";
  if (scene.leaves_out("side_friction")) grain.side_friction = 0;
  return scene;
}

std::vector<std::string> switched_off(const Scene& scene) {
  std::vector<std::string> sentences;
  for (const Effect& e : called_for(scene)) {
    if (!e.on || !scene.leaves_out(e.name)) continue;
    if (const auto remedy = remedies().find(e.name); remedy != remedies().end()) {
      throw SceneError(
          fmt::format("{}: effects.{} is off, but the scene calls for it ({}), and it is no term that a run can leave out; {}",
                      scene.places.of("effects." + e.name), e.name, e.reason, remedy->second));
    }
    sentences.push_back(
        fmt::format("effects.{} is off, although the scene calls for it ({}): the run leaves it out.", e.name, e.reason));
  }
  return sentences;
}

}  // namespace couloir
