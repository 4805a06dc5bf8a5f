#pragma once
#include <map>
#include <string>

namespace couloir {

// Key -> where it was written. A key that was not written has its nearest mapping's place, then the file's.
class Places {
 public:
  explicit Places(std::string file = "scene") : file_(std::move(file)) {}
  void note(const std::string& key, const std::string& place) { places_[key] = place; }
  const std::string& of(std::string key) const;
  bool has(const std::string& key) const { return places_.contains(key); }

 private:
  std::string file_;
  std::map<std::string, std::string> places_;
};

}  // namespace couloir
