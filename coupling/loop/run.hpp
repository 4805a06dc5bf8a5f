#pragma once
// One run of a scene, in its mode, watched by observers.
//
//   scene -> [solver] [engine] -> windows -> observers
//
// continuum: solver only; grains: engine only; coupled: the solver everywhere but in the zone (zone.hpp), the engine from the
// moment the flow nears it.

#include <functional>
#include <string>
#include <vector>

#include "continuum/mesh/ranks.hpp"
#include "coupling/engine/grain_engine.hpp"
#include "coupling/loop/observer.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

struct RunOptions {
  int threads = 1;
  Ranks ranks{};  // that share the continuum; mode continuum only. All run the same; only the first has observers and a work_dir
  std::string work_dir;  // of the engine and for checkpoints; must exist
  std::string workers;   // folder of the engines' workers
  std::string packings;  // folder in which settled packings are kept
  std::function<bool()> interrupted = [] { return false; };
  std::function<void(const GrainEngine&)> on_engine = [](const GrainEngine&) {};  // when it has started (tests kill it here)
};

// Runs to the end, to an interrupt, or to an error. In every case observers see on_finish, and a checkpoint of what can be saved
// is in work_dir when the run did not end by itself. Throws NumericsError, EngineError after that; SceneError before the start.
RunEnd run_scene(const Scene&, const RunOptions&, const std::vector<Observer*>&);

}  // namespace couloir
