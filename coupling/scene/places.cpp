#include "coupling/scene/places.hpp"

namespace couloir {

const std::string& Places::of(std::string key) const {
  while (true) {
    if (const auto found = places_.find(key); found != places_.end()) return found->second;
    const auto dot = key.rfind('.');
    if (dot == std::string::npos) return file_;
    key.resize(dot);
  }
}

}  // namespace couloir
