#pragma once
// YAML text -> Node. document.cpp is the only user of yaml-cpp.

#include <string>

#include "coupling/scene/node.hpp"

namespace couloir {

// The whole file. Throws SceneError if it cannot be read.
std::string read_document_text(const std::string& path);

// `name` goes before the line numbers. Throws SceneError for bad YAML and for keys given twice.
Node parse_document(const std::string& text, const std::string& name);

// One value as after `--set key=`; every node's place is `place`.
Node parse_value(const std::string& text, const std::string& place);

}  // namespace couloir
