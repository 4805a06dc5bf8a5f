#pragma once
// RUN/summary.json as somebody has left it: edited, cut short or gone.
#include <nlohmann/json.hpp>
#include <string>

namespace couloir {

struct SummaryFile {
  nlohmann::json content = nlohmann::json::object();
  std::string fault;  // "is missing", for after the file's name; empty: it is an object
};
SummaryFile read_summary(const std::string& path);

}  // namespace couloir
