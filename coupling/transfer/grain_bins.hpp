#pragma once
// Spheres in bins of space: whether one would overlap another by more than is harmless.

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "coupling/engine/grain_engine.hpp"

namespace couloir {

class GrainBins {
 public:
  // [m] period along y; 0: none.
  explicit GrainBins(double largest_diameter, double period = 0) : size_(largest_diameter), period_(period) {}

  void add(const Vec& centre, double radius) { bins_[bin(centre, 0, 0, 0)].push_back({centre, radius}); }

  // Whether a sphere there comes closer to another than `share` of the sum of their radii.
  bool meets(const Vec& p, double r, double share) const {
    if (meets_there(p, r, share)) return true;
    return period_ > 0 &&
           (meets_there({p[0], p[1] + period_, p[2]}, r, share) || meets_there({p[0], p[1] - period_, p[2]}, r, share));
  }

 private:
  bool meets_there(const Vec& p, double r, double share) const {
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b)
        for (int c = -1; c <= 1; ++c) {
          const auto found = bins_.find(bin(p, a, b, c));
          if (found == bins_.end()) continue;
          for (const auto& [q, radius] : found->second) {
            const double dx = q[0] - p[0], dy = q[1] - p[1], dz = q[2] - p[2], reach = share * (radius + r);
            if (dx * dx + dy * dy + dz * dz < reach * reach) return true;
          }
        }
    return false;
  }

  std::uint64_t bin(const Vec& p, int a, int b, int c) const {
    const auto part = [&](double x, int off) {
      return std::uint64_t(std::int64_t(std::floor(x / size_)) + off + (1 << 20)) & 0x1fffff;
    };
    return part(p[0], a) << 42 | part(p[1], b) << 21 | part(p[2], c);
  }
  struct Sphere {
    Vec centre;
    double radius;
  };
  double size_, period_;
  std::unordered_map<std::uint64_t, std::vector<Sphere>> bins_;
};

}  // namespace couloir
