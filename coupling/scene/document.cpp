#include "coupling/scene/document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

using PlaceOf = std::function<std::string(const YAML::Mark&)>;

// An alias may hold itself, or aliases of aliases without end: no scene is that deep or that large.
struct Limits {
  int depth = 0;
  int* nodes;
  Limits deeper() const { return {depth + 1, nodes}; }
};
constexpr int most_depth = 20, most_nodes = 100000;

Node converted(const YAML::Node& yaml, const std::string& place, const PlaceOf& place_of, Limits limits) {
  if (limits.depth > most_depth || ++*limits.nodes > most_nodes)
    throw SceneError(
        fmt::format("{}: this goes deeper than {} levels or holds more than {} entries; does an alias (*name) hold itself?",
                    place, most_depth, most_nodes));
  Node node;
  node.place = place;
  switch (yaml.Type()) {
    case YAML::NodeType::Undefined:
    case YAML::NodeType::Null:
      break;
    case YAML::NodeType::Scalar:
      node.kind = Node::Kind::text;
      node.text = yaml.Scalar();
      break;
    case YAML::NodeType::Sequence:
      node.kind = Node::Kind::list;
      for (const auto& item : yaml) node.items.push_back(converted(item, place_of(item.Mark()), place_of, limits.deeper()));
      break;
    case YAML::NodeType::Map:
      node.kind = Node::Kind::mapping;
      for (const auto& entry : yaml) {
        const YAML::Node &key = entry.first, &value = entry.second;
        const std::string where = place_of(key.Mark());
        if (!key.IsScalar()) throw SceneError(where + ": a key must be a plain word");
        if (const Node* first = node.find(key.Scalar())) {
          throw SceneError(
              fmt::format("{}: {} is given twice, first at {}; keep one of them", where, key.Scalar(), first->place));
        }
        node.entries.emplace_back(key.Scalar(), converted(value, where, place_of, limits.deeper()));
      }
      break;
  }
  return node;
}

}  // namespace

std::string read_document_text(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw SceneError(path + ": there is no such file; give a scene file, or a folder that holds scene.yaml");
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (std::filesystem::is_directory(path, error) || !file || !(text << file.rdbuf())) {
    throw SceneError(path + ": the file cannot be read, or is empty; is it a text file with read permission?");
  }
  return text.str();
}

Node parse_document(const std::string& text, const std::string& name) {
  const PlaceOf place_of = [&](const YAML::Mark& mark) { return fmt::format("{}:{}", name, mark.line + 1); };
  try {
    int nodes = 0;
    return converted(YAML::Load(text), name + ":1", place_of, {0, &nodes});
  } catch (const YAML::Exception& error) {
    throw SceneError(fmt::format("{}: this is not YAML: {}", place_of(error.mark), error.msg));
  }
}

Node parse_value(const std::string& text, const std::string& place) {
  try {
    int nodes = 0;
    return converted(YAML::Load(text), place, [&](const YAML::Mark&) { return place; }, {0, &nodes});
  } catch (const YAML::Exception& error) {
    throw SceneError(fmt::format("{}: '{}' is not a YAML value: {}", place, text, error.msg));
  }
}

}  // namespace couloir
