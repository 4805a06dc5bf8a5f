#pragma once
// Reads one mapping of expected.yaml key by key: refuses what is unknown, says where and what was meant.

#include <string>
#include <vector>

#include "coupling/scene/node.hpp"

namespace couloir {

class CaseFields {
 public:
  // `what` names the mapping in messages: "a case". Throws SceneError where the node is no mapping or holds other keys.
  CaseFields(const Node&, std::string what, const std::vector<std::string>& names);

  const Node* find(const std::string& name) const { return node_.find(name); }
  const Node& need(const std::string& name) const;
  std::string text(const std::string& name, const std::string& otherwise = "") const;
  const std::vector<Node>& list(const std::string& name) const;  // empty where it is missing

  [[noreturn]] void fail(const Node& at, const std::string& name, const std::string& what) const;

 private:
  const Node& node_;
  std::string what_;
};

// A node as YAML text on one line, for an override.
std::string override_text(const Node&);

}  // namespace couloir
