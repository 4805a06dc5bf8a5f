#pragma once
// Small runs of nested grids that several tests share.

#include "continuum/noc/nested_noc.hpp"
#include "noc_scenes.hpp"

namespace couloir::test {

// The heap that slides over the bump of heap_on_bump(), with a patch over a part of both.
inline NestedNoc nested_heap(int threads, int levels, double mirror = 1, Limiter limiter = Limiter::minmod,
                             std::array<Side, 4> s4 = sides(Side::Kind::outflow, Side::Kind::wall)) {
  const HeapOnBump heap{{60, 40, 1.0 / 64, 1.0 / 64, 0, -20.0 / 64}, 0.55, 0.09, 0.2, 0.2, mirror};
  SolverSettings s = heap.settings(threads, s4, limiter);
  const double y = mirror > 0 ? -0.1 : -0.2;
  s.refinement.boxes.push_back({0.4, 0.65, y, y + 0.3, levels, 0});
  return heap.solver<NestedNoc>(s);
}

// All states of all grids.
inline std::vector<double> all_of(const NestedNoc& s) {
  const Bits b = bits_of(s);
  std::vector<double> all = b.h;
  all.insert(all.end(), b.hu.begin(), b.hu.end());
  all.insert(all.end(), b.hv.begin(), b.hv.end());
  for (int p = 0; p < s.patches(); ++p) {
    const Grid g = s.patch_grid(p);
    for (int j = 0; j < g.ny; ++j) {
      for (int i = 0; i < g.nx; ++i) {
        const FlowState q = s.patch_at(p, i, j);
        all.insert(all.end(), {q.h, q.hu, q.hv});
      }
    }
  }
  return all;
}

}  // namespace couloir::test
