#pragma once
// The folder of a run that an earlier call has kept.
#include <nlohmann/json.hpp>
#include <string>

namespace couloir {

struct KeptRun {
  bool is_there = false;
  std::string fault;       // why it is no done run: "summary.json cannot be read"; empty: it is one
  nlohmann::json summary;  // of a done run
  bool done() const { return is_there && fault.empty(); }
};
KeptRun kept_run(const std::string& folder);

}  // namespace couloir
