#pragma once
// Node -> Scene by the schema: refuses what the schema does not know, reads what it does, remembers where it stood.

#include <map>
#include <string>

#include "coupling/scene/node.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// Key -> where it was written. A key that was not written has its nearest mapping's place, then the file's.
class Places {
 public:
  explicit Places(std::string file = "scene") : file_(std::move(file)) {}
  void note(const std::string& key, const std::string& place) { places_[key] = place; }
  const std::string& of(std::string key) const;

 private:
  std::string file_;
  std::map<std::string, std::string> places_;
};

// Fills `scene`, which holds the defaults. Throws SceneError with place, key and remedy.
void bind(const Node& document, Scene& scene, Places& places);

}  // namespace couloir
