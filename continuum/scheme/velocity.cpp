#include "continuum/scheme/velocity.hpp"

#include <cmath>

#include "continuum/scheme/effects.hpp"

namespace couloir {

void find_velocity(const Parameters& p, const Block& b, const Fields& q, Scratch& w) {
  const double *h = q.h.data(), *hu = q.hu.data(), *hv = q.hv.data(), *bed = b.bed.data();
  double *u = w.u.data(), *v = w.v.data(), *eta = w.eta.data();
  const double dry = p.dry_depth;
  const int n = b.size();
  double still = 0;
#pragma omp simd reduction(+ : still)
  for (int c = 0; c < n; ++c) {
    const bool wet = h[c] >= dry;
    const double per_depth = 1 / (wet ? h[c] : 1.0);
    u[c] = wet ? hu[c] * per_depth : 0.0;
    v[c] = wet ? hv[c] * per_depth : 0.0;
    still += std::abs(u[c]) + std::abs(v[c]) > 0 ? 0.0 : 1.0;
  }
  w.still = still > 0;
  if (with_relief(b)) {
#pragma omp simd
    for (int c = 0; c < n; ++c) eta[c] = h[c] + bed[c];
  }
}

}  // namespace couloir
