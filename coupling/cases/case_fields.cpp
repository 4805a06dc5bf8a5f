#include "coupling/cases/case_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {

CaseFields::CaseFields(const Node& node, std::string what, const std::vector<std::string>& names)
    : node_(node), what_(std::move(what)) {
  if (node.kind != Node::Kind::mapping && node.kind != Node::Kind::nothing)
    throw SceneError(
        fmt::format("{}: {} is {}, but must be a mapping with {}", node.place, what_, describe(node), fmt::join(names, ", ")));
  for (const auto& [name, entry] : node.entries) {
    if (std::ranges::count(names, name) > 0) continue;
    throw SceneError(fmt::format("{}: {} is unknown{}", entry.place, name, suggestion(name, names, what_ + " takes")));
  }
}

const Node& CaseFields::need(const std::string& name) const {
  if (const Node* found = find(name)) return *found;
  throw SceneError(fmt::format("{}: {} needs the key {}", node_.place, what_, name));
}

std::string CaseFields::text(const std::string& name, const std::string& otherwise) const {
  const Node* found = find(name);
  if (!found) return otherwise;
  if (found->kind != Node::Kind::text) fail(*found, name, fmt::format("is {}, but must be a text", describe(*found)));
  return found->text;
}

const std::vector<Node>& CaseFields::list(const std::string& name) const {
  static const std::vector<Node> none;
  const Node* found = find(name);
  if (!found || found->kind == Node::Kind::nothing) return none;
  if (found->kind != Node::Kind::list) fail(*found, name, fmt::format("is {}, but must be a list", describe(*found)));
  return found->items;
}

void CaseFields::fail(const Node& at, const std::string& name, const std::string& what) const {
  throw SceneError(fmt::format("{}: {} {}", at.place, name, what));
}

std::string override_text(const Node& node) {
  std::vector<std::string> parts;
  switch (node.kind) {
    case Node::Kind::nothing:
      return "~";
    case Node::Kind::list:
      for (const Node& item : node.items) parts.push_back(override_text(item));
      return fmt::format("[{}]", fmt::join(parts, ", "));
    case Node::Kind::mapping:
      for (const auto& [name, entry] : node.entries) parts.push_back(name + ": " + override_text(entry));
      return fmt::format("{{{}}}", fmt::join(parts, ", "));
    case Node::Kind::text:
      break;
  }
  const bool plain = !node.text.empty() && node.text != "~" &&
                     node.text.find_first_of(",:[]{}#&*!|>'\"%@`\\\n") == std::string::npos && node.text.front() != ' ' &&
                     node.text.back() != ' ' && node.text.front() != '?' && node.text != "-";
  if (plain) return node.text;
  std::string quoted = "\"";
  for (const char c : node.text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace couloir
