#pragma once
// Piecewise linear reconstruction of h, h + z_b, u, v along one axis (MUSCL).
//
//       lo   q   hi           slope by the limiter from the differences to both neighbours;
//    |  x----x----x  |        (lo + hi) / 2 = q, which the positivity bound of the scheme needs

#include "continuum/scheme/axis.hpp"
#include "continuum/scheme/limiter.hpp"

namespace couloir {

template <class L>
void reconstruct(const Block& b, const Axis& axis, const double* __restrict q, double* __restrict lo, double* __restrict hi) {
  const int step = axis.step;
  for (int j = axis.first_j(); j < axis.faces_j; ++j) {
    const int begin = b.at(axis.first_i(), j), end = b.at(axis.faces_i, j);
#pragma omp simd
    for (int c = begin; c < end; ++c) {
      const double half = 0.5 * L::slope(q[c] - q[c - step], q[c + step] - q[c]);
      lo[c] = q[c] - half;
      hi[c] = q[c] + half;
    }
  }
}

// All four quantities. On a bed without relief the surface is the depth.
template <class L>
void reconstruct_all(const Block& b, const Axis& axis, const Fields& q, const Scratch& w, FaceValues& f) {
  reconstruct<L>(b, axis, q.h.data(), f.h_lo.data(), f.h_hi.data());
  if (b.relief) {
    reconstruct<L>(b, axis, w.eta.data(), f.eta_lo.data(), f.eta_hi.data());
  } else {
    f.eta_lo = f.h_lo;
    f.eta_hi = f.h_hi;
  }
  reconstruct<L>(b, axis, axis.un, f.un_lo.data(), f.un_hi.data());
  reconstruct<L>(b, axis, axis.ut, f.ut_lo.data(), f.ut_hi.data());
}

}  // namespace couloir
