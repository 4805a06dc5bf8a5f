#include "continuum/scheme/reconstruct.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/scheme/effects.hpp"
#include "continuum/scheme/limiter.hpp"
#include "continuum/scheme/min_max.hpp"

namespace couloir {
namespace {

// A shock: the velocity falls across the cell by more than these shares of the wave speed and of itself. What runs onto a dry bed
// is none.
constexpr double shock_strength = 0.1, shock_share = 0.1;

// From the first to the last cell whose face values are needed, in one run: the ghosts at the rows' ends among them are of no
// use, but cost less than a loop for each row.
struct Run {
  int begin, end;
};
Run cells_of(const Block& b, const Axis& axis) {
  return {b.at(axis.first_i(), axis.first_j()), b.at(axis.faces_i - 1, axis.faces_j - 1) + 1};
}

// The depth keeps half of itself at either face. Steeper limiters would draw it to zero at the face to a dry cell: what the
// slope drives there could not leave, and would gain speed without end. minmod never draws more.
template <class L, bool flattening>
void reconstruct_depth(const Block& b, const Axis& axis, const double* __restrict smooth, const double* __restrict q,
                       double* __restrict lo, double* __restrict hi) {
  const int step = axis.step;
  const auto [begin, end] = cells_of(b, axis);
#pragma omp simd
  for (int c = begin; c < end; ++c) {
    const double most = 0.5 * q[c];
    const double half =
        std::min(std::max(0.5 * (flattening ? smooth[c] : 1.0) * L::slope(q[c] - q[c - step], q[c + step] - q[c]), -most), most);
    lo[c] = q[c] - half;
    hi[c] = q[c] + half;
  }
}

template <class L, bool flattening>
void reconstruct(const Block& b, const Axis& axis, const double* __restrict smooth, const double* __restrict q,
                 double* __restrict lo, double* __restrict hi) {
  const int step = axis.step;
  const auto [begin, end] = cells_of(b, axis);
#pragma omp simd
  for (int c = begin; c < end; ++c) {
    const double half = 0.5 * (flattening ? smooth[c] : 1.0) * L::slope(q[c] - q[c - step], q[c + step] - q[c]);
    lo[c] = q[c] - half;
    hi[c] = q[c] + half;
  }
}

// The surface; where the bed is level it follows the depth, whose slope may be held (above): else the bed would seem to slope
// there.
template <class L, bool flattening>
void reconstruct_surface(const Block& b, const Axis& axis, const double* __restrict smooth, const double* __restrict eta,
                         const double* __restrict h_lo, const double* __restrict h_hi, double* __restrict lo,
                         double* __restrict hi) {
  const int step = axis.step;
  const double* bed = b.bed.data();
  const auto [begin, end] = cells_of(b, axis);
#pragma omp simd
  for (int c = begin; c < end; ++c) {
    const double half = 0.5 * (flattening ? smooth[c] : 1.0) * L::slope(eta[c] - eta[c - step], eta[c + step] - eta[c]);
    const double uneven = std::abs(bed[c] - bed[c - step]) + std::abs(bed[c + step] - bed[c]);
    lo[c] = uneven > 0 ? eta[c] - half : h_lo[c] + bed[c];
    hi[c] = uneven > 0 ? eta[c] + half : h_hi[c] + bed[c];
  }
}

template <class L, bool flattening>
void reconstruct_each(const Block& b, const Axis& axis, const Fields& q, const Scratch& w, FaceValues& f) {
  const double* smooth = w.smooth.data();
  reconstruct_depth<L, flattening>(b, axis, smooth, q.h.data(), f.h_lo.data(), f.h_hi.data());
  if (with_relief(b)) {
    reconstruct_surface<L, flattening>(b, axis, smooth, w.eta.data(), f.h_lo.data(), f.h_hi.data(), f.eta_lo.data(),
                                       f.eta_hi.data());
  }
  reconstruct<L, flattening>(b, axis, smooth, axis.un, f.un_lo.data(), f.un_hi.data());
  reconstruct<L, flattening>(b, axis, smooth, axis.ut, f.ut_lo.data(), f.ut_hi.data());
}

}  // namespace

void find_shocks(const Parameters& p, const Block& b, const Axis& axis, const Fields& q, Values& smooth) {
  if (!with_friction(p)) {
    if (with_relief(b)) std::fill(smooth.begin(), smooth.end(), 1.0);
    return;
  }
  const int step = axis.step;
  const double dry = p.dry_depth;
  const double *h = q.h.data(), *un = axis.un, *k = axis.k, *weight = b.weight.data() + Block::ghosts;
  double* s = smooth.data();
  for (int j = axis.first_j(); j < axis.faces_j; ++j) {
    const int row = b.at(0, j);
#pragma omp simd
    for (int i = axis.first_i(); i < axis.faces_i; ++i) {
      const int c = row + i;
      const double h_below = h[c - step], h_above = h[c + step], un_below = un[c - step], un_above = un[c + step];
      const double deepest = larger(larger(h[c], 0.0), larger(h_below, h_above));
      const double below = h_below >= dry ? un_below : un[c], above = h_above >= dry ? un_above : un[c];
      const double beyond = larger(below - above - shock_share * std::abs(un[c]), 0.0);
      s[c] = beyond * beyond > shock_strength * shock_strength * (k[c] * weight[i] * deepest) ? 0.0 : 1.0;
    }
  }
}

void reconstruct_all(const Parameters& p, const Block& b, const Axis& axis, const Fields& q, const Scratch& w, FaceValues& f) {
  with_limiter(p.limiter, [&](auto limiter) {
    using L = decltype(limiter);
    with_flattening(p, b) ? reconstruct_each<L, built::all>(b, axis, q, w, f) : reconstruct_each<L, false>(b, axis, q, w, f);
  });
}

}  // namespace couloir
