#include "coupling/cases/packings.hpp"

#include <limits>

#include "coupling/cases/scatter.hpp"

namespace couloir {
namespace {

nlohmann::json figure(const Scatter& s) {
  return {{"mean", s.mean}, {"scatter", s.scatter}, {"least", s.least}, {"largest", s.largest}, {"count", s.count}};
}

double number_at(const nlohmann::json& summary, const nlohmann::json::json_pointer& at) {
  const bool there = summary.contains(at) && summary.at(at).is_number();
  return there ? summary.at(at).get<double>() : std::numeric_limits<double>::quiet_NaN();
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
    out[section] = nlohmann::json::object();
    if (done.empty()) continue;
    for (const auto& [name, figures] : done.front().at(section).items()) {
      for (const auto& [key, first] : figures.items()) {
        const auto at = nlohmann::json::json_pointer() / section / name / key;
        std::vector<double> values;
        for (const nlohmann::json& summary : done) values.push_back(number_at(summary, at));
        if (const Scatter s = scatter_of(values); s.count > 0) out[section][name][key] = figure(s);
      }
    }
  }
  return out;
}

}  // namespace couloir
