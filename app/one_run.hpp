#pragma once
// What the verbs run and resume share: a scene, in its folder, watched by all that record it.

#include <CLI/CLI.hpp>

#include "continuum/mesh/ranks.hpp"
#include "coupling/records/run_folder.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

struct OneRun {
  int threads = 1, ranks = 1;
  bool json = false, no_report = false;
  bool resume = false;
  std::string name;  // of the verb

  void declare(CLI::App&);
  // Throws SceneError where the scene is not for several ranks, or the program was not started on them.
  Ranks ranks_for(const Scene&) const;
};

// Of a rank that is not the first. `checkpoints`: their folder; any name where the run is a new one. Returns the exit code.
int help_run(const OneRun&, const Scene&, const Ranks&, const std::string& checkpoints);

// Returns the exit code; throws what run_scene throws, after it has said where the run can be gone on with.
int run_in(const RunFolder&, const OneRun&, const Scene&, const Ranks&);

// Replicates, report and what is printed, of a run that has come to an end. Returns the exit code.
int finish_run(const RunFolder&, const OneRun&, const Scene&, int exit_code);

}  // namespace couloir
