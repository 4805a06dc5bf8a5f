#pragma once
// The slopes (3.18)-(3.21) of the reconstruction, one type a choice. slope(w, s) is the difference per spacing at *w, from the
// values s apart on the same line.

#include "continuum/scheme/limiter.hpp"

namespace couloir::noc {

// Total variation diminishing: from the differences to the two neighbours.
template <class L>
struct SlopeTvd {
  static double slope(const double* w, int s) { return L::slope(w[0] - w[-s], w[s] - w[0]); }
};

// Essentially non-oscillatory of second order (Harten and Osher 1987; (3.1d) of Nessyahu and Tadmor 1990): each one-sided
// difference is carried to the middle with the smaller second difference, so that extrema keep their slope.
struct SlopeEno {
  static double slope(const double* w, int s) {
    const double below = w[0] - w[-s], above = w[s] - w[0];
    const double here = above - below, before = below - (w[-s] - w[-2 * s]), after = (w[2 * s] - w[s]) - above;
    return LimiterMinmod::slope(below + 0.5 * LimiterMinmod::slope(before, here),
                                above - 0.5 * LimiterMinmod::slope(here, after));
  }
};

// Calls f with the slope's type: chosen once, not asked in the inner loop.
template <class F>
void with_slope(Limiter limiter, F&& f) {
  if (limiter == Limiter::eno) return f(SlopeEno{});
  with_limiter(limiter, [&](auto l) { f(SlopeTvd<decltype(l)>{}); });
}

}  // namespace couloir::noc
