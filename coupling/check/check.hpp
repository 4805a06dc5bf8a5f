#pragma once
// Runs what the cases ask for and judges it.

#include <functional>
#include <string>
#include <vector>

#include "coupling/cases/run_pool.hpp"
#include "coupling/check/verdict.hpp"

namespace couloir {

struct CheckSettings {
  int jobs = 1;                                                                   // runs at a time
  std::function<void(const std::vector<Finding>&)> on_case = [](const auto&) {};  // when a case is judged; one at a time
  std::function<bool()> stop = [] { return false; };  // true: no more cases; those left have no finding
};

// Findings in the order of the files and their cases. Every scene is read before the first run starts. Throws SceneError where
// a scene or a quantity's path is wrong; a run that fails is a finding with verdict fail.
std::vector<Finding> check_experiments(const std::vector<Expected>&, RunPool&, const std::string& materials,
                                       const CheckSettings&);

}  // namespace couloir
