#pragma once
// A packing for tests, made by arithmetic: rows of grains on a lattice, each row shifted along x so that the mass comes evenly.

#include <algorithm>
#include <cmath>
#include <random>

#include "coupling/transfer/packing_table.hpp"

namespace couloir {

inline Packing lattice_packing(double d = 0.005, int n = 20, int layers = 12) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.02 * d, 0.02 * d), radius(0.45 * d, 0.48 * d);
  Packing p;
  p.length = p.width = n * d;
  p.depth = layers * d;
  for (int k = 0; k < layers; ++k)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        p.grains.push_back({std::fmod(i + 0.618034 * (j + n * k), n) * d, (j + 0.5) * d + jitter(random),
                            (k + 0.5) * d + jitter(random), radius(random)});
  std::stable_sort(p.grains.begin(), p.grains.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  double volume = 0;
  for (const auto& g : p.grains) volume += 4.0 / 3.0 * M_PI * g.r * g.r * g.r;
  p.solid_fraction = volume / (p.length * p.width * p.depth);
  return p;
}

}  // namespace couloir
