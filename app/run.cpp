#include <memory>

#include "app/one_run.hpp"
#include "app/scene_options.hpp"
#include "app/verbs.hpp"
#include "coupling/plan/limits.hpp"
#include "coupling/scene/reader.hpp"

namespace couloir {
namespace {

struct RunVerb : OneRun {
  SceneOptions scene;
  std::string out;
};

int run(const RunVerb& verb) {
  const Scene scene = verb.scene.read();
  const Ranks ranks = verb.ranks_for(scene);
  check_memory(scene, make_plan(scene), verb.ranks);
  if (!ranks.first()) return help_run(verb, scene, ranks, "checkpoint");
  const RunFolder folder = RunFolder::create(scene, verb.out, write_scene(scene));
  return finish_run(folder, verb, scene, run_in(folder, verb, scene, ranks));
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunVerb>();
  CLI::App* verb = app.add_subcommand("run", "run a scene and draw its report");
  options->scene.declare(*verb);
  verb->add_option("--out", options->out, "the run's folder; default: runs/<scene>-<mode>");
  options->declare(*verb);
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace couloir
