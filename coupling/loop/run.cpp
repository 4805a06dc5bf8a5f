#include "coupling/loop/run.hpp"

#include <fmt/format.h>

#include <optional>

#include "coupling/loop/mode_run.hpp"
#include "coupling/plan/zone.hpp"
#include "coupling/scene/reader.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

// The first line that two texts do not share, as each has it.
std::pair<std::string, std::string> first_change(const std::string& a, const std::string& b) {
  std::istringstream one(a), two(b);
  std::string p, q;
  while (true) {
    const bool more = bool(std::getline(one, p)), other = bool(std::getline(two, q));
    if (!more) p = "(nothing)";
    if (!other) q = "(nothing)";
    if (p != q || !more) return {p, q};
  }
}

void require_same(const Checkpoint& c, const Scene& scene, const RunOptions& options) {
  if (c.made_by != options.made_by) {
    throw SceneError(
        fmt::format("{}: the checkpoint was made by couloir {}, and this is {}: it would not go on to the same bits; check that "
                    "one out, or start "
                    "the run anew",
                    options.checkpoints, c.made_by, options.made_by));
  }
  if (const std::string text = write_scene(scene); text != c.scene) {
    const auto [then, now] = first_change(c.scene, text);
    throw SceneError(
        fmt::format("{}: the scene has changed since the checkpoint: '{}' was '{}'; put it back, or run the new scene anew",
                    scene.file, now, then));
  }
}

}  // namespace

RunEnd run_scene(const Scene& scene, const RunOptions& options, const std::vector<Observer*>& observers) {
  const auto make = scene.mode == Mode::continuum ? continuum_run : has_zones(scene) ? coupled_run : grains_run;
  std::optional<CheckpointFolder> folder;
  if (!options.checkpoints.empty() && options.ranks.first()) {
    folder.emplace(options.checkpoints);
    if (!folder->lock())
      throw SceneError(options.checkpoints + ": another process is at this run; wait for it, or stop it first");
  }
  std::optional<ModeRun::Return> back;
  if (options.resume) {
    back = {CheckpointFolder::read(options.checkpoints), "resumed"};
    require_same(back->checkpoint, scene, options);
  }
  const auto go = [&](bool patient) {
    return make(scene, options, observers)->go(folder ? &*folder : nullptr, back ? &*back : nullptr, patient);
  };
  std::string lost;
  try {
    return go(true);
  } catch (const ModeRun::EngineLost& error) {
    lost = error.what();
  }
  back = {CheckpointFolder::read(options.checkpoints), lost};
  return go(false);
}

}  // namespace couloir
