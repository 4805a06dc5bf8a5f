#include "coupling/records/compare_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace couloir {
namespace {

using Numbers = std::map<std::string, double>;  // by path; NaN: null

bool of_the_run_alone(const std::string& path) {
  for (const char* begin : {"time.wall", "time.cpu", "time.share_", "costs", "resumed"})
    if (path.starts_with(begin)) return true;
  return path.ends_with("_per_second");
}

void collect(const nlohmann::json& node, const std::string& path, Numbers& out) {
  if (of_the_run_alone(path)) return;
  const std::string begin = path.empty() ? "" : path + ".";
  if (node.is_object())
    for (const auto& [name, below] : node.items()) collect(below, begin + name, out);
  else if (node.is_array())
    for (std::size_t k = 0; k < node.size(); ++k) collect(node[k], begin + std::to_string(k), out);
  else if (node.is_number())
    out[path] = node.get<double>();
  else if (node.is_null())
    out[path] = std::numeric_limits<double>::quiet_NaN();
}

Numbers numbers_of(const nlohmann::json& summary) {
  Numbers out;
  collect(summary, "", out);
  return out;
}

std::string name_of(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

bool is_instant(const std::string& name) {
  return name == "arrival" || name == "first_contact" || name.ends_with("_time");
}

bool is_judged(const std::string& path, bool grains) {
  const std::string name = name_of(path);
  if (path.starts_with("mass.")) return !name.starts_with("relative");
  if (grains) return name.starts_with("impulse");
  if (is_instant(name) || path.starts_with("obstacles_together.difference")) return false;
  for (const char* section : {"obstacles", "walls.", "gauges.", "flow."})
    if (path.starts_with(section)) return true;
  return false;
}

// Figures of one kind have one scale: "mass", "obstacles.wall force".
std::string kind_of(const std::string& path) {
  if (path.starts_with("mass.")) return "mass";
  const std::string name = name_of(path), object = path.starts_with("walls.") ? "walls" : path.substr(0, path.rfind('.'));
  const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
  for (const char* kind : {"impulse", "depth"})
    if (has(kind)) return object + " " + kind;
  if (has("speed") || has("velocity")) return object + " speed";
  for (const char* force : {"force", "maximum", "peak", "mean", "final"})
    if (name.starts_with(force)) return object + " force";
  return object + " " + name.substr(0, name.find('_'));
}

double scale_of(const std::string& path, const Numbers& all) {
  double scale = 0;
  for (const auto& [other, value] : all)
    if (kind_of(path) == kind_of(other) && !is_instant(name_of(other)) && std::isfinite(value))
      scale = std::max(scale, std::abs(value));
  return scale;
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace

std::string summary_difference(const nlohmann::json& first, const nlohmann::json& second, std::optional<double> tolerance,
                               bool grains) {
  const Numbers a = numbers_of(first), b = numbers_of(second);
  std::vector<std::string> found;
  const auto shown = [](double value) { return std::isnan(value) ? "null" : fmt::format("{:.6g}", value); };
  for (const auto& [path, x] : a) {
    const auto at = b.find(path);
    if (at == b.end()) {
      if (!tolerance) found.push_back(path + " that it has not");
      continue;
    }
    const double y = at->second;
    if (same(x, y)) continue;
    if (tolerance && !is_judged(path, grains)) continue;
    const bool within = tolerance && std::abs(x - y) <= *tolerance * std::max(scale_of(path, a), scale_of(path, b));
    if (within) continue;
    const bool close = shown(x) == shown(y);  // six digits do not tell them apart
    found.push_back(close ? fmt::format("{} {:.17g} for {:.17g}", path, x, y)
                          : fmt::format("{} {} for {}", path, shown(x), shown(y)));
  }
  if (!tolerance)
    for (const auto& [path, y] : b)
      if (!a.contains(path)) found.push_back(path + " is missing");
  if (found.empty()) return "";
  return found.size() == 1 ? found.front() : fmt::format("{}, and {} more", found.front(), found.size() - 1);
}

}  // namespace couloir
