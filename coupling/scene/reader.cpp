#include "coupling/scene/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <sstream>

#include "coupling/scene/binder.hpp"
#include "coupling/scene/bodies.hpp"
#include "coupling/scene/check.hpp"
#include "coupling/scene/document.hpp"
#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of_materials(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

void mark_si(Node& node) {
  node.si = true;
  for (Node& item : node.items) mark_si(item);
  for (auto& [name, entry] : node.entries) mark_si(entry);
}

// A material given by name becomes the mapping in its file, so that the rest of the reader knows one form only.
void expand_material(Node& material, const std::string& folder) {
  if (material.kind != Node::Kind::text) return;
  const std::string name = material.text, place = material.place;
  const auto names = names_of_materials(folder);
  if (std::ranges::count(names, name) == 0) {
    const std::string there =
        names.empty() ? fmt::format("there are no materials in {}", folder) : fmt::format("there are {}", fmt::join(names, ", "));
    const std::string nearest = nearest_name(name, names);
    throw SceneError(fmt::format("{}: material '{}' is unknown; {}, or write its keys inline{}", place, name, there,
                                 nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  }
  const std::string path = (fs::path(folder) / (name + ".yaml")).string();
  material = parse_document(read_document_text(path), path);
  if (material.kind != Node::Kind::mapping) throw SceneError(path + ": a material file must hold a mapping of keys");
  if (!material.find("name")) material.entry("name") = Node::of_text(name, path + ":1");
  mark_si(material);
}

// Cuts "[2]" off the end of a word; -1: there is none.
int cut_number(std::string& word) {
  const auto bracket = word.find('[');
  if (bracket == 0 || bracket == std::string::npos || word.back() != ']') return -1;
  int number = -1;
  const char *first = word.data() + bracket + 1, *last = word.data() + word.size() - 1;
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc() || end != last || number < 0) return -1;
  word.resize(bracket);
  return number;
}

// Puts `text` where the dotted key leads; the binder judges the result like the rest of the file.
void apply_override(Node& document, const std::string& key, const std::string& text, const std::string& materials) {
  const std::string place = "--set " + key;
  std::istringstream words(key);
  Node* node = &document;
  std::string path, word;
  while (std::getline(words, word, '.')) {
    if (word.empty()) throw SceneError(fmt::format("{}: the key has an empty part; write it like grains.seed", place));
    if (path == "material") expand_material(*node, materials);
    if (node->kind == Node::Kind::nothing) node->kind = Node::Kind::mapping;
    if (node->kind != Node::Kind::mapping) {
      throw SceneError(fmt::format("{0}: {1} is {2}, not a mapping; set it whole: --set {1}={{{3}: ...}}", place, path,
                                   describe(*node), word));
    }
    const int number = cut_number(word);
    node = &node->entry(word);
    if (node->place.empty()) node->place = place;
    path += (path.empty() ? "" : ".") + word;
    if (number < 0) continue;
    const int items = static_cast<int>(node->items.size());
    if (number >= items) {
      throw SceneError(
          fmt::format("{}: {} has {} entries, counted from 0; set it whole: --set '{}=[...]'", place, path, items, path));
    }
    node = &node->items[number];
    path += fmt::format("[{}]", number);
  }
  if (path.empty() || key.back() == '.')
    throw SceneError(fmt::format("{}: the key has an empty part; write it like grains.seed", place));
  *node = parse_value(text, place);
  // Zones are given by one of two keys: the one that is set takes the place of the other.
  const std::string zone = "grains.zone", zones = "grains.zones", whole = path.substr(0, path.find_first_of(".[", zone.size()));
  if (whole == zone || whole == zones)
    std::erase_if(document.entry("grains").entries,
                  [&](const auto& e) { return "grains." + e.first == (whole == zone ? zones : zone); });
}

// The scene whose text this one holds, which stands in `file`.
Scene bound(Scene scene, const std::string& file, const std::string& materials, const Overrides& overrides) {
  Node document = parse_document(scene.text, file);
  if (document.kind != Node::Kind::mapping) bind(document, scene);  // says what it is instead
  for (const auto& [key, text] : overrides) apply_override(document, key, text, materials);
  for (auto& [name, entry] : document.entries) {
    if (name == "material") expand_material(entry, materials);
  }

  scene.places = Places(file);
  bind(document, scene);
  read_bodies(scene, fs::path(file).parent_path().string());
  check_scene(scene);
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path, const std::string& materials, const Overrides& overrides) {
  std::error_code error;
  const std::string file = fs::is_directory(path, error) ? (fs::path(path) / "scene.yaml").string() : path;
  Scene scene;
  scene.file = path;
  scene.text = read_document_text(file);
  return bound(std::move(scene), file, materials, overrides);
}

Scene read_scene_text(const std::string& text, const std::string& file, const std::string& materials) {
  Scene scene;
  scene.file = file;
  scene.text = text;
  return bound(std::move(scene), file, materials, {});
}

Material read_material(const std::string& name, const std::string& materials) {
  Node document = parse_document("terrain: {kind: flat, length: 1, width: 1}\nrelease: {kind: none}\nduration: 1\n", name);
  Node& material = document.entry("material") = Node::of_text(name, name);
  expand_material(material, materials);
  Scene scene;
  scene.places = Places(name);
  bind(document, scene);
  return scene.material;
}

}  // namespace couloir
