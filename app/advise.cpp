#include <fmt/format.h>

#include <memory>

#include "app/scene_options.hpp"
#include "app/verbs.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/study/advice.hpp"

namespace couloir {
namespace {

struct AdviseVerb {
  SceneOptions scene;
  std::string error, quantity, ladders = COULOIR_SOURCE_DIR "/experiments";
  bool json = false;
};

int advise(const AdviseVerb& verb) {
  const double wanted = share_of("--error", verb.error, "10 %");
  if (wanted == 0) throw SceneError("--error 0: no model is exact; give what may be off, such as 10 %");
  if (wanted >= 1)
    throw SceneError(fmt::format("--error {0}: is {1:.4g} %; give a share below 100 %, such as 10 %", verb.error, 100 * wanted));
  const Advice advice =
      advise(verb.scene.path, materials_folder(), verb.scene.overrides(), wanted, verb.quantity, kept_ladders(verb.ladders));
  if (verb.json)
    fmt::print("{}\n", advice_json(advice, verb.scene.path).dump(2));
  else
    fmt::print("{}", advice_text(advice, verb.scene.path));
  return advice.choice.rung < 0 ? 1 : 0;
}

}  // namespace

void add_advise(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<AdviseVerb>();
  CLI::App* verb =
      app.add_subcommand("advise", "which model and settings do for a scene, by the ladder of the scene most like it");
  options->scene.declare(*verb);
  verb->add_option("--error", options->error, "that a run may be off by, such as 10 %")->required();
  verb->add_option("--quantity", options->quantity,
                   "of summary.json, such as obstacles.wall.impulse; default: the ladder's first");
  verb->add_option("--ladders", options->ladders, "folder with ladder.json files; default: the experiments");
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options, &exit_code] { exit_code = advise(*options); });
}

}  // namespace couloir
