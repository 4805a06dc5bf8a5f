#pragma once
// Which model and settings do for a scene, by the kept ladder (ladder.json) of the scene that is most like it.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupling/scene/reader.hpp"
#include "coupling/study/ladder.hpp"
#include "coupling/study/likeness.hpp"

namespace couloir {

struct KeptRung {
  std::string name, mode;
  Overrides set;
  double cells_in_depth = 0, grains_in_depth = 0;  // NaN: there are none
  double planned = 0;                              // [s] by the plan
};

struct KeptQuantity {
  std::string path, source;  // source: of the reference
  double floor = 0;
  std::vector<RungFigures> rungs;
};

struct KeptLadder {
  std::string file, name;
  Likeness scene;
  std::vector<KeptRung> rungs;
  std::vector<RungCost> costs;
  std::vector<KeptQuantity> quantities;
};

// All ladder.json under the paths. Throws SceneError where there is none, and where one is damaged.
std::vector<KeptLadder> kept_ladders(const std::string& folder);

struct Advice {
  KeptLadder ladder;  // the nearest that has the quantity
  std::size_t quantity = 0;
  Likeness scene;
  double distance = 0;
  LadderChoice choice;   // rung -1: none is good enough; of rungs whose keys mean something here, and whom the scene takes
  Overrides given, set;  // what the caller set, and for the rung: as many cells and grains in the depth as it had, its other keys
  double cost = 0;       // [s] here: the rung's, by the ratio of the plans
  std::vector<std::string> refused;  // cheaper rungs that this scene does not take, each with the reason
  int nearest = -1;                  // where none is good enough: the best of the others, -1: there is none
  double nearest_error = 0;
};

// `path` is read with `set`, as read_scene. `quantity` empty: the ladder's first. Throws SceneError.
Advice advise(const std::string& path, const std::string& materials, const Overrides& set, double error,
              const std::string& quantity, const std::vector<KeptLadder>&);

// How far the ladder's scene may be trusted to stand for this one.
const char* trust(double distance);

std::string advice_text(const Advice&, const std::string& path);
nlohmann::ordered_json advice_json(const Advice&, const std::string& path);

}  // namespace couloir
