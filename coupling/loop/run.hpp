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
  std::string work_dir;     // of the engine; must exist
  std::string checkpoints;  // folder; empty: none are kept. A rank that is not the first only has to know that there is one
  std::string made_by;      // the program's revision, for checkpoints
  bool resume = false;      // go on from the checkpoint there
  std::string workers;      // folder of the engines' workers
  std::string packings;     // folder in which settled packings are kept
  std::function<bool()> interrupted = [] { return false; };
  std::function<void(const GrainEngine&)> on_engine = [](const GrainEngine&) {};  // when it has started (tests kill it here)
};

// Runs to the end, to an interrupt, or to an error. In every case observers see on_finish, and the last checkpoint stays where
// the run did not come to its end. Where the engine fails the run goes on from the last checkpoint, once. Throws NumericsError,
// EngineError, CheckpointError after that; SceneError before the start, also where `resume` finds a checkpoint of another scene
// or revision.
RunEnd run_scene(const Scene&, const RunOptions&, const std::vector<Observer*>&);

}  // namespace couloir
