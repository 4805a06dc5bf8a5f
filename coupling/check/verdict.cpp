#include "coupling/check/verdict.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

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

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "FAIL";
    case Verdict::shown:
      return "shown";
    case Verdict::skipped:
      return "skipped";
  }
  return "?";
}

double summary_value(const nlohmann::json& summary, const std::string& path, const std::string& place) {
  const auto bar = path.find(" / ");
  if (bar == std::string::npos) return one_value(summary, path, place);
  const double below = one_value(summary, path.substr(bar + 3), place);
  return below == 0 ? nan : one_value(summary, path.substr(0, bar), place) / below;
}

void judge(Finding& f, double si) {
  const Expectation& e = f.expectation;
  f.value = si / e.unit.si;
  const double off = f.value - e.value;
  f.deviation = e.value == 0 ? nan : off / std::abs(e.value);
  switch (e.tolerance.kind) {
    case Tolerance::Kind::none:
      f.verdict = Verdict::shown;
      break;
    case Tolerance::Kind::relative:  // a NaN compares false: fail
      f.verdict = std::abs(off) <= e.tolerance.size * std::abs(e.value) ? Verdict::pass : Verdict::fail;
      break;
    case Tolerance::Kind::absolute:
      f.verdict = std::abs(off) <= e.tolerance.size ? Verdict::pass : Verdict::fail;
      break;
  }
  if (std::isnan(f.value)) f.reason = "the run has no such value (null)";
}

}  // namespace couloir
