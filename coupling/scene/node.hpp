#pragma once
// A scene file as a tree of texts that know where they were written.

#include <string>
#include <utility>
#include <vector>

namespace couloir {

struct Node {
  enum class Kind { nothing, text, list, mapping } kind = Kind::nothing;
  std::string text;
  std::vector<Node> items;                            // list
  std::vector<std::pair<std::string, Node>> entries;  // mapping, in the file's order; each node's place is its key's
  std::string place;                                  // "scene.yaml:14" or "--set grains.seed"
  bool si = false;                                    // from a material file: bare numbers are SI whatever the scene's scales

  static Node of_text(std::string text, std::string place);
  const Node* find(const std::string& name) const;  // nullptr: no such entry
  Node& entry(const std::string& name);             // made where it is missing
};

// "text 'auto'", "a list", ...; for messages.
std::string describe(const Node&);

}  // namespace couloir
