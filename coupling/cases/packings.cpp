#include "coupling/cases/packings.hpp"

#include <limits>

#include "coupling/cases/scatter.hpp"

namespace couloir {
namespace {

nlohmann::json figure(const Scatter& s) {
  return {{"mean", s.mean}, {"scatter", s.scatter}, {"least", s.least}, {"largest", s.largest}, {"count", s.count}};
}

using Pointer = nlohmann::json::json_pointer;

double number_at(const nlohmann::json& summary, const Pointer& at) {
  const bool there = summary.contains(at) && summary.at(at).is_number();
  return there ? summary.at(at).get<double>() : std::numeric_limits<double>::quiet_NaN();
}

// Of all numbers at this place and under it, as the first run has them; null where there are none.
nlohmann::json figures_at(const std::vector<nlohmann::json>& done, const Pointer& at) {
  nlohmann::json out;
  const nlohmann::json& first = done.front().at(at);
  if (first.is_object()) {
    for (const auto& [key, below] : first.items())
      if (nlohmann::json found = figures_at(done, at / key); !found.is_null()) out[key] = std::move(found);
    return out;
  }
  std::vector<double> values;
  for (const nlohmann::json& summary : done) values.push_back(number_at(summary, at));
  if (const Scatter s = scatter_of(values); s.count > 0) out = figure(s);
  return out;
}

}  // namespace

nlohmann::json over_packings(const std::vector<PackingRun>& runs) {
  nlohmann::json out{{"seeds", nlohmann::json::array()}, {"runs", nlohmann::json::array()}, {"failed", nlohmann::json::array()}};
  std::vector<nlohmann::json> done;
  for (const PackingRun& run : runs) {
    if (run.failure.empty()) {
      out["seeds"].push_back(run.seed);
      out["runs"].push_back(run.folder);
      done.push_back(run.summary);
    } else {
      out["failed"].push_back({{"seed", run.seed}, {"reason", run.failure}});
    }
  }
  out["count"] = done.size();
  for (const std::string section : {"obstacles", "walls"}) {
    const nlohmann::json figures = done.empty() ? nlohmann::json() : figures_at(done, Pointer() / section);
    out[section] = figures.is_null() ? nlohmann::json::object() : figures;
  }
  return out;
}

}  // namespace couloir
