#include "coupling/scene/node.hpp"

namespace couloir {

Node Node::of_text(std::string text, std::string place) {
  Node node;
  node.kind = Kind::text;
  node.text = std::move(text);
  node.place = std::move(place);
  return node;
}

const Node* Node::find(const std::string& name) const {
  for (const auto& [key, value] : entries) {
    if (key == name) return &value;
  }
  return nullptr;
}

Node& Node::entry(const std::string& name) {
  for (auto& [key, value] : entries) {
    if (key == name) return value;
  }
  return entries.emplace_back(name, Node{}).second;
}

std::string describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::nothing:
      return "empty";
    case Node::Kind::text:
      return "'" + node.text + "'";
    case Node::Kind::list:
      return "a list";
    case Node::Kind::mapping:
      return "a mapping";
  }
  return "?";
}

}  // namespace couloir
