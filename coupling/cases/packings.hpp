#pragma once
// One scene with several packings (grains.replicates): what the runs say together.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace couloir {

struct PackingRun {
  long seed = 0;
  std::string folder;      // of the run, from the folder of the first
  std::string failure;     // one sentence; empty: done
  nlohmann::json summary;  // null where it failed
};

// {"count": done runs, "seeds": [...], "runs": [...], "failed": [{"seed", "reason"}],
//  "obstacles": {name: {figure: {"mean", "scatter", "least", "largest", "count"}}}, "walls": likewise}
// Every figure of obstacles and walls, in SI as in each summary; the scatter is the standard deviation of a sample. A figure that
// a run has not (no contact) is left out of its count; NaN is null.
nlohmann::json over_packings(const std::vector<PackingRun>&);

}  // namespace couloir
