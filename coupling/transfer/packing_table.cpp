#include "coupling/transfer/packing_table.hpp"

#include <algorithm>
#include <stdexcept>

namespace couloir {

PackingTable::PackingTable(const Packing& packing, double grain_density) : packing_(packing), grain_density_(grain_density) {
  if (packing_.grains.empty()) throw std::invalid_argument("a packing without grains cannot serve as stock");
  auto by_height = packing_.grains;
  std::stable_sort(by_height.begin(), by_height.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  const double area = packing_.length * packing_.width;
  double below = 0;
  for (const auto& grain : by_height) {
    below += grain_mass(grain.r);
    height_.push_back(grain.z);
    cumulative_.push_back(below / area);
  }
  mean_mass_ = below / double(by_height.size());
}

double PackingTable::grain_mass(double radius) const {
  return couloir::grain_mass(radius, grain_density_);
}

double PackingTable::cut(double areal_mass) const {
  if (areal_mass <= 0) return -1;
  const auto at = std::lower_bound(cumulative_.begin(), cumulative_.end(), areal_mass) - cumulative_.begin();
  return at == long(height_.size()) ? height_.back() + 1 : height_[at];
}

}  // namespace couloir
