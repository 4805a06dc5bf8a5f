#include "coupling/study/study_unit.hpp"

#include <fmt/format.h>

#include <vector>

#include "coupling/scene/document.hpp"
#include "coupling/scene/schema.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

// "continuum.refine[0].levels" -> continuum, refine, 0, levels
std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.' || c == '[')
      parts.emplace_back();
    else if (c != ']')
      parts.back() += c;
  }
  return parts;
}

Dimension dimension_of(const std::string& path) {
  const std::vector<std::string> given = parts_of(path);
  for (const Key& key : schema()) {
    const std::vector<std::string> known = parts_of(key.path);
    bool same = known.size() == given.size();
    for (std::size_t k = 0; same && k < known.size(); ++k) same = known[k] == "*" || known[k] == given[k];
    if (same) return key.dimension;
  }
  return Dimension::none;
}

}  // namespace

CaseUnit unit_of_bare(const std::string& key, const Scene& scene) {
  const Dimension dimension = dimension_of(key);
  if (dimension == Dimension::none) return {};
  const Node document = parse_document(scene.text, scene.file);
  const Node* scales = document.find("scales");
  const Node* length = scales ? scales->find("length") : nullptr;
  const bool defines_scales = dimension == Dimension::acceleration || dimension == Dimension::density;
  if (!length || defines_scales || dimension == Dimension::angle) return parse_case_unit(si_unit(dimension));
  if (dimension != Dimension::length) return {"scale (2.47)", describe(dimension), 1};
  const auto [number, unit] = parse_case_value(length->text);
  return number == 1 ? unit : parse_case_unit(length->text);
}

CaseUnit unit_of_path(const std::string& path) {
  const auto bar = path.find(" / ");
  if (bar != std::string::npos) {
    const std::string above = unit_of_path(path.substr(0, bar)).text, below = unit_of_path(path.substr(bar + 3)).text;
    if (above == below) return {};
    if (!below.empty() && above.ends_with(" " + below)) return {above.substr(0, above.size() - below.size() - 1), "", 1};
    const std::string first = above.empty() ? "1" : above.find('/') == std::string::npos ? above : "(" + above + ")";
    return {below.empty() ? first : fmt::format("{}/{}", first, below), "", 1};
  }
  const std::string quantity = quantity_of_path(path);
  if (quantity.empty() || quantity == "a plain number") return {};
  return parse_case_unit(units_of_quantity(quantity).front());
}

}  // namespace couloir
