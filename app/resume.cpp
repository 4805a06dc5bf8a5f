#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/one_run.hpp"
#include "app/replicates.hpp"
#include "app/scene_options.hpp"
#include "app/verbs.hpp"
#include "coupling/checkpoint/checkpoint_folder.hpp"
#include "coupling/plan/limits.hpp"
#include "coupling/records/summary_file.hpp"
#include "coupling/scene/reader.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

struct ResumeVerb : OneRun {
  std::string run;
};

bool has_ended_well(const RunFolder& folder) {
  const nlohmann::json summary = read_summary(folder.file("summary.json")).content;
  return summary.contains("status") && summary["status"] == "done";
}

// Of a run that is done itself: whether packings are missing.
bool wants_packings(const RunFolder& folder, const Scene& scene) {
  if (scene.grains.replicates <= 1 || scene.mode == Mode::continuum) return false;
  try {
    packing_folders(folder, scene);
    return false;
  } catch (const SceneError&) {
    return true;
  }
}

int resume(ResumeVerb& verb) {
  const RunFolder folder = RunFolder::open(verb.run);
  const Scene scene = read_scene(folder.file("scene.yaml"), materials_folder(), {});
  const std::string checkpoints = folder.file("checkpoint");
  if (has_ended_well(folder)) {
    if (wants_packings(folder, scene)) return finish_run(folder, verb, scene, 0);
    throw SceneError(
        fmt::format("{}: this run is done, there is nothing to go on with; couloir report {} draws it", verb.run, verb.run));
  }
  if (!CheckpointFolder::holds_one(checkpoints)) {
    throw SceneError(
        fmt::format("{}: this run has no checkpoint: it ended before its first window, or its folder checkpoint was taken away; "
                    "run it anew: couloir run {} --out ANOTHER",
                    verb.run, folder.file("scene.yaml")));
  }
  const Ranks ranks = verb.ranks_for(scene);
  check_memory(scene, make_plan(scene), verb.ranks);
  verb.resume = true;
  if (!ranks.first()) return help_run(verb, scene, ranks, checkpoints);
  return finish_run(folder, verb, scene, run_in(folder, verb, scene, ranks));
}

}  // namespace

void add_resume(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ResumeVerb>();
  CLI::App* verb = app.add_subcommand("resume", "go on with a run that was broken off, from its last checkpoint");
  verb->add_option("RUN", options->run, "the run's folder")->required();
  options->declare(*verb);
  verb->callback([options, &exit_code] { exit_code = resume(*options); });
}

}  // namespace couloir
