// Compiled once for each instruction set (cmake/kernels.cmake).

#include "bench/flow/bare_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/scheme/limiter.hpp"
#include "continuum/scheme/min_max.hpp"

namespace couloir::bench {
namespace {

constexpr int edge = BareBlock::edge, row = BareBlock::row;

void find_velocity(const BareBlock& b, BareScratch& w) {
  const double *h = b.h.data(), *hu = b.hu.data(), *hv = b.hv.data();
  double *u = w.u.data(), *v = w.v.data();
#pragma omp simd
  for (int c = 0; c < BareBlock::size; ++c) {
    const double per_depth = 1 / h[c];
    u[c] = hu[c] * per_depth;
    v[c] = hv[c] * per_depth;
  }
}

void reconstruct(const double* q, double* lo, double* hi, int step) {
  const int begin = BareBlock::at(0, 0) - step, end = BareBlock::at(edge - 1, edge - 1) + step + 1;
#pragma omp simd
  for (int c = begin; c < end; ++c) {
    const double half = 0.5 * LimiterMinmod::slope(q[c] - q[c - step], q[c + step] - q[c]);
    lo[c] = q[c] - half;
    hi[c] = q[c] + half;
  }
}

void fluxes(BareScratch& w, int axis, double g) {
  const bool x = axis == 0;
  const int step = x ? 1 : row, faces_i = edge + (x ? 1 : 0), faces_j = edge + (x ? 0 : 1);
  const double *h_lo = w.h_lo.data(), *h_hi = w.h_hi.data(), *un_lo = w.un_lo.data(), *un_hi = w.un_hi.data(),
               *ut_lo = w.ut_lo.data(), *ut_hi = w.ut_hi.data();
  double *mass = w.mass[axis].data(), *normal = w.normal[axis].data(), *tangent = w.tangent[axis].data();
  for (int j = 0; j < faces_j; ++j) {
    const int first = BareBlock::at(0, j);
#pragma omp simd
    for (int i = 0; i < faces_i; ++i) {
      const int r = first + i, l = r - step;
      const double hl = h_hi[l], hr = h_lo[r], ul = un_hi[l], ur = un_lo[r], cl = std::sqrt(g * hl), cr = std::sqrt(g * hr);
      const double sl = smaller(smaller(ul - cl, ur - cr), 0.0), sr = larger(larger(ul + cl, ur + cr), 0.0);
      const double per_width = 1 / (sr - sl), ql = hl * ul, qr = hr * ur;
      const double ml = ql * ul + 0.5 * g * hl * hl, mr = qr * ur + 0.5 * g * hr * hr;
      const double m = (sr * ql - sl * qr + sl * sr * (hr - hl)) * per_width;
      mass[r] = m;
      normal[r] = (sr * ml - sl * mr + sl * sr * (qr - ql)) * per_width;
      tangent[r] = m * (m > 0 ? ut_hi[l] : ut_lo[r]);
    }
  }
}

template <bool corrector>
void update(BareBlock& b, BareScratch& w, double courant, double g) {
  double *h = b.h.data(), *hu = b.hu.data(), *hv = b.hv.data(), *h0 = b.h0.data(), *hu0 = b.hu0.data(), *hv0 = b.hv0.data();
  const double *x_mass = w.mass[0].data(), *x_normal = w.normal[0].data(), *x_tangent = w.tangent[0].data();
  const double *y_mass = w.mass[1].data(), *y_normal = w.normal[1].data(), *y_tangent = w.tangent[1].data();
  double* fastest = w.fastest.data();
  for (int j = 0; j < edge; ++j) {
    const int first = BareBlock::at(0, j);
#pragma omp simd
    for (int i = 0; i < edge; ++i) {
      const int c = first + i;
      double new_h = h[c] - courant * ((x_mass[c + 1] - x_mass[c]) + (y_mass[c + row] - y_mass[c]));
      double new_hu = hu[c] - courant * ((x_normal[c + 1] - x_normal[c]) + (y_tangent[c + row] - y_tangent[c]));
      double new_hv = hv[c] - courant * ((x_tangent[c + 1] - x_tangent[c]) + (y_normal[c + row] - y_normal[c]));
      if constexpr (corrector) {
        new_h = 0.5 * (h0[c] + new_h);
        new_hu = 0.5 * (hu0[c] + new_hu);
        new_hv = 0.5 * (hv0[c] + new_hv);
        fastest[i] = larger(fastest[i], (std::abs(new_hu) + std::abs(new_hv)) / new_h + 2 * std::sqrt(g * new_h));
      } else {
        h0[c] = h[c], hu0[c] = hu[c], hv0[c] = hv[c];
      }
      h[c] = new_h, hu[c] = new_hu, hv[c] = new_hv;
    }
  }
}

double stage(BareBlock& b, BareScratch& w, bool corrector, double courant, double g) {
  find_velocity(b, w);
  for (int axis : {0, 1}) {
    const int step = axis == 0 ? 1 : row;
    reconstruct(b.h.data(), w.h_lo.data(), w.h_hi.data(), step);
    reconstruct((axis == 0 ? w.u : w.v).data(), w.un_lo.data(), w.un_hi.data(), step);
    reconstruct((axis == 0 ? w.v : w.u).data(), w.ut_lo.data(), w.ut_hi.data(), step);
    fluxes(w, axis, g);
  }
  std::fill(w.fastest.begin(), w.fastest.end(), 0.0);
  corrector ? update<true>(b, w, courant, g) : update<false>(b, w, courant, g);
  return *std::max_element(w.fastest.begin(), w.fastest.end());
}

}  // namespace

extern "C" {
extern const BareKernel COULOIR_TABLE;
const BareKernel COULOIR_TABLE{stage};
}

}  // namespace couloir::bench
