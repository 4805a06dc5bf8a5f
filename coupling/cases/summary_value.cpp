#include "coupling/cases/summary_value.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double one_value(const nlohmann::json& summary, const std::string& path, const std::string& place) {
  const nlohmann::json* node = &summary;
  std::string done;
  for (std::size_t at = 0; at <= path.size();) {
    const auto dot = std::min(path.find('.', at), path.size());
    const std::string name = path.substr(at, dot - at);
    if (!node->is_object() || !node->contains(name)) {
      std::vector<std::string> names;
      if (node->is_object())
        for (const auto& [known, value] : node->items()) names.push_back(known);
      const std::string there = done.empty() ? "a summary has" : done + " has";
      throw SceneError(fmt::format("{}: the quantity {} is not in the run's summary.json: {} is unknown{}", place, path, name,
                                   names.empty() ? "" : suggestion(name, names, there)));
    }
    node = &node->at(name);
    done += (done.empty() ? "" : ".") + name;
    at = dot + 1;
  }
  if (node->is_null()) return nan;
  if (!node->is_number())
    throw SceneError(fmt::format("{}: the quantity {} is no number in the run's summary.json", place, path));
  return node->get<double>();
}

}  // namespace

double summary_value(const nlohmann::json& summary, const std::string& path, const std::string& place) {
  const auto bar = path.find(" / ");
  if (bar == std::string::npos) return one_value(summary, path, place);
  const double above = one_value(summary, path.substr(0, bar), place), below = one_value(summary, path.substr(bar + 3), place);
  return below == 0 ? nan : above / below;
}

}  // namespace couloir
