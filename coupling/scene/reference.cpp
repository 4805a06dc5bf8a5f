// The schema as a page for people.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "coupling/scene/schema.hpp"

namespace couloir {
namespace {

std::string kind_of(const Key& key) {
  const std::string unit = si_unit(key.dimension);
  switch (key.kind) {
    case ValueKind::number: {
      const std::string word = key.choices.empty() ? "" : key.choices.front() + " or ";
      return word + (unit.empty() ? "number" : fmt::format("{} [{}]", std::string(describe(key.dimension)), unit));
    }
    case ValueKind::numbers:
      return fmt::format("list of {} [{}]", key.count, unit);
    case ValueKind::table: {
      std::vector<std::string> units;
      for (const Dimension d : key.columns) units.push_back(si_unit(d));
      if (units.front().empty()) return fmt::format("list of rows of {} whole numbers", units.size());
      return fmt::format("list of rows [{}]", fmt::join(units, ", "));
    }
    case ValueKind::integer:
      return "whole number";
    case ValueKind::text:
      return "text";
    case ValueKind::choice:
      return "choice";
    case ValueKind::mapping:
      return key.choices.empty() ? "mapping" : "choice or mapping";
    case ValueKind::named:
      return "mapping by name";
    case ValueKind::list:
      return "list of mappings";
  }
  return "?";
}

// From scene.hpp: the value of a scene in which nothing is set.
std::string default_of(const Key& key) {
  if (key.presence == Presence::required) return key.selector.empty() ? "required" : "required there";
  if (key.presence == Presence::optional && key.kind == ValueKind::choice) return key.choices.front();
  if (key.presence == Presence::optional) return key.written ? "none" : "the material's";
  if (!key.get) return "";
  Scene blank;
  blank.obstacles.emplace_back();
  blank.record.gauges.emplace_back();
  blank.continuum.refine.emplace_back();
  const Value value = key.get(blank, 0);
  if (const auto* number = std::get_if<double>(&value))
    return *number == 0 && !key.choices.empty() ? key.choices.front() : short_quantity(*number, key.dimension);
  if (const auto* number = std::get_if<long>(&value)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return "";
}

std::string row(const Key& key) {
  std::string help = key.help;
  if (!key.selector.empty()) help += fmt::format(" ({} {})", key.selector, fmt::join(key.selected, ", "));
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", key.path, kind_of(key), default_of(key), allowed_values(key), help);
}

constexpr const char* head = R"(# Scene reference

Generated from coupling/scene/schema.cpp. Do not edit.

Values are SI unless they carry a unit: `80 mm`, `40 deg`, `1639 kg/m3`, `20 ms`, `5 MPa`. An angle always needs its unit.
With `scales: {length: 33.33 mm}` bare numbers are multiples of the scales (2.47). `--set key=value` overrides a key: `--set grains.seed=7`.
`*` stands for a name of your choice, in a list of mappings for its entries: `--set 'continuum.refine=[{around: wall, levels: 2}]'`,
`--set 'continuum.refine[0].levels=3'`. What is said in brackets after a help text tells where a key belongs.
)";

}  // namespace

std::string scene_reference() {
  std::string page = head;
  std::string section = "?";
  for (const Key& key : schema()) {
    const std::string top = key.path.substr(0, key.path.find('.'));
    const bool plain = key.parent().empty() && key.kind != ValueKind::mapping && key.kind != ValueKind::named;
    const std::string here = plain ? "the run" : top;
    if (here != section) {
      page += fmt::format("\n## {}\n\n| key | kind | default | allowed | help |\n| --- | --- | --- | --- | --- |\n", here);
      section = here;
    }
    page += row(key);
  }
  return page;
}

}  // namespace couloir
