#include "coupling/scene/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace couloir {

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size() + 1;
  std::vector<int> d((a.size() + 1) * n);
  for (std::size_t i = 0; i <= a.size(); ++i) d[i * n] = static_cast<int>(i);
  for (std::size_t j = 0; j < n; ++j) d[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j < n; ++j) {
      const int change = d[(i - 1) * n + j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      int least = std::min({d[(i - 1) * n + j] + 1, d[i * n + j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) least = std::min(least, d[(i - 2) * n + j - 2] + 1);
      d[i * n + j] = least;
    }
  }
  return d.back();
}

std::string nearest_name(std::string_view given, const std::vector<std::string>& names) {
  std::string nearest;
  int least = 0;
  for (const std::string& name : names) {
    const int distance = edit_distance(given, name);
    const int near = std::max<int>(1, static_cast<int>(std::max(given.size(), name.size())) / 3);
    if (distance <= near && (nearest.empty() || distance < least)) {
      nearest = name;
      least = distance;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view given, const std::vector<std::string>& names, std::string_view what) {
  const std::string nearest = nearest_name(given, names);
  if (!nearest.empty()) return fmt::format("; did you mean '{}'?", nearest);
  return fmt::format("; {} {}", what, fmt::join(names, ", "));
}

}  // namespace couloir
