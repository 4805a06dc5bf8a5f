#include <cstdio>
#include <memory>

#include "app/scene_options.hpp"
#include "app/verbs.hpp"
#include "coupling/plan/plan.hpp"

namespace couloir {

void add_plan(CLI::App& app, int&) {
  struct Options {
    SceneOptions scene;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("plan", "what will run, why, and what it will cost; computes nothing");
  options->scene.declare(*verb);
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options] {
    const Plan plan = make_plan(options->scene.read());
    if (options->json)
      std::puts(plan_json(plan).dump(2).c_str());
    else
      std::fputs(plan_text(plan).c_str(), stdout);
  });
}

}  // namespace couloir
