#pragma once
// What a case asks the pool for: one run, or a search over runs.

#include <optional>
#include <string>
#include <vector>

#include "coupling/cases/run_pool.hpp"
#include "coupling/cases/search.hpp"

namespace couloir {

struct CaseRun {
  std::string name, variant;  // variant empty: the file has none
  std::string scene;          // path of the scene file
  Overrides set;              // later ones win
  std::optional<Search> search;
  std::string place;  // where the file asks for it
};

struct CaseOutcome {
  PooledRun run;                // of a search: at the critical value, where there is one
  double critical = 0;          // of a search; NaN: none
  std::string failure;          // one sentence; empty: done
  std::string remark;           // SearchResult::remark
  std::vector<PooledRun> runs;  // all of them, each once
};

// Reads the scenes that the case will run, for a search those at both ends, so that an error in one of them comes before hours of
// work. Throws SceneError with the case's place and name.
std::vector<Scene> scenes_of(const CaseRun&, const std::string& materials);

// Waits for the runs. Throws SceneError where a scene or the search's quantity is wrong, Stopped.
CaseOutcome run_case(const CaseRun&, RunPool&);

}  // namespace couloir
