#pragma once
// Runs what the cases ask for and judges it.

#include <functional>
#include <string>
#include <vector>

#include "coupling/check/run_pool.hpp"
#include "coupling/check/verdict.hpp"

namespace couloir {

struct CheckSettings {
  int jobs = 1;                                                                   // runs at a time
  std::function<void(const std::vector<Finding>&)> on_case = [](const auto&) {};  // when a case is judged; one at a time
};

// Findings in the order of the files and their cases. Every scene is read before the first run starts. Throws SceneError where
// a scene or a quantity's path is wrong; a run that fails is a finding with verdict fail.
std::vector<Finding> check_experiments(const std::vector<Expected>&, RunPool&, const std::string& materials,
                                       const CheckSettings&);

// The value of a search: the first n on the grid from, from + step, ... with good(n), found by halving; NaN where the last is
// not good. The quantity must fall as the value rises: then bad values lie below good ones.
double smallest_good(const Search&, const std::function<bool(double value)>& good);

// Why there is none, from the quantity (SI; NaN: null) at the search's lowest and highest value.
std::string why_none_is_good(const Search&, double low, double high);

}  // namespace couloir
