#include "coupling/study/ladder_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

// What all rungs set comes first, so that a rung's own wins.
Node merged(const Node* of_all, const Node* own, const std::string& place) {
  Node out;
  out.kind = Node::Kind::mapping;
  out.place = place;
  for (const Node* part : {of_all, own}) {
    if (!part) continue;
    for (const auto& [key, value] : part->entries) out.entry(key) = value;
  }
  return out;
}

LadderRung rung_of(const Node& node, const Node* set) {
  const CaseFields f(node, "a rung", {"name", "mode", "set", "quick", "replicates"});
  f.need("name");
  LadderRung out{f.text("name"), f.text("mode"), node, &node};
  std::erase_if(out.table.entries, [](const auto& entry) { return entry.first == "mode"; });
  if (const Node* own = f.find("set"); own && own->kind != Node::Kind::mapping)
    f.fail(*own, "set", "must be a mapping from the scene's keys to values");
  out.table.entry("set") = merged(set, f.find("set"), node.place);
  if (!out.mode.empty() && out.mode != mass_point_mode) {
    Node modes;
    modes.kind = Node::Kind::list;
    modes.place = node.place;
    modes.items.push_back(*f.find("mode"));
    out.table.entry("modes") = modes;
  }
  return out;
}

LadderValue value_of(const Node& node, const CaseReader& reader) {
  const CaseFields f(node, "a reference", {"quantity", "value", "source"});
  LadderValue out{f.need("quantity").text, f.text("source"), 0, {}, &node};
  std::tie(out.value, out.unit) = reader.parsed(f.need("value"), "value", parse_case_value);
  if (out.source.empty()) f.fail(node, "source", "is missing: say where the reference comes from");
  if (out.value == 0) f.fail(f.need("value"), "value", "is 0: an error over it has no meaning");
  return out;
}

}  // namespace

LadderNode::LadderNode(const Node& node, const CaseReader& reader)
    : fields(node, "a ladder", {"quantities", "reference", "errors", "set", "replicates", "rungs"}) {
  for (const Node& item : fields.list("rungs")) {
    rungs.push_back(rung_of(item, fields.find("set")));
    if (std::ranges::count(rungs, rungs.back().name, &LadderRung::name) > 1)
      fields.fail(item, "name", fmt::format("'{}' is a rung already", rungs.back().name));
  }
  if (rungs.empty()) fields.fail(node, "rungs", "are missing: models and settings, the cheapest first");
  const Node& given = fields.need("reference");
  if (given.kind == Node::Kind::list) {
    for (const Node& item : given.items) values.push_back(value_of(item, reader));
  } else {
    reference = fields.text("reference");
    std::vector<std::string> names;
    for (const LadderRung& rung : rungs) names.push_back(rung.name);
    if (!holds(names, reference))
      fields.fail(given, "reference", fmt::format("'{}' is no rung{}", reference, suggestion(reference, names, "there are")));
  }
  for (const Node& item : fields.list("errors")) {
    const auto [number, unit] = reader.parsed(item, "errors", parse_case_value);
    const double share = number * unit.si;
    if (!(unit.text.empty() || unit.text == "%") || !(share > 0))
      fields.fail(item, "errors", fmt::format("holds {}, but takes shares above 0, such as 10 %", item.text));
    errors.push_back(share);
  }
}

}  // namespace couloir
