#include "coupling/plan/plan.hpp"

#include <cstdio>
#include <memory>

#include "app/scene_options.hpp"
#include "app/verbs.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/schema.hpp"

namespace couloir {

void add_plan(CLI::App& app, int&) {
  struct Options {
    SceneOptions scene;
    bool json = false, reference = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("plan", "what will run, why, and what it will cost; computes nothing");
  options->scene.declare(*verb);
  verb->get_option("SCENE")->required(false);
  verb->add_flag("--json", options->json, "machine-readable");
  verb->add_flag("--reference", options->reference, "print all keys of a scene with unit, bounds and meaning, and end");
  verb->callback([options] {
    if (options->reference) {
      std::fputs(scene_reference().c_str(), stdout);
      return;
    }
    if (options->scene.path.empty()) throw SceneError("plan needs a SCENE: a scene file, or an experiment's folder");
    const Plan plan = make_plan(options->scene.read());
    if (options->json)
      std::puts(plan_json(plan).dump(2).c_str());
    else
      std::fputs(plan_text(plan).c_str(), stdout);
  });
}

}  // namespace couloir
