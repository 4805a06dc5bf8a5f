#pragma once
// Slope limiters: the slope of a cell from the differences a, b to its two neighbours. All are symmetric in (a, b), odd, zero at
// extrema and at most twice the smaller difference, so face values stay between the neighbours' means.

#include <algorithm>
#include <cmath>

namespace couloir {

enum class Limiter { minmod, van_leer, mc, superbee, eno };  // eno: scheme noc only (noc/slopes.hpp)

struct LimiterMinmod {
  static double slope(double a, double b) { return a * b > 0 ? (std::abs(a) < std::abs(b) ? a : b) : 0.0; }
};

struct LimiterVanLeer {
  static double slope(double a, double b) { return a * b > 0 ? 2 * a * b / (a + b) : 0.0; }
};

struct LimiterMc {
  static double slope(double a, double b) {
    const double least = std::min(2 * std::min(std::abs(a), std::abs(b)), 0.5 * std::abs(a + b));
    return a * b > 0 ? std::copysign(least, a) : 0.0;
  }
};

struct LimiterSuperbee {
  static double slope(double a, double b) {
    const double p = std::abs(a), q = std::abs(b);
    const double most = std::max(std::min(2 * p, q), std::min(p, 2 * q));
    return a * b > 0 ? std::copysign(most, a) : 0.0;
  }
};

// Calls f with the limiter's type: chosen once, not asked in the inner loop.
template <class F>
void with_limiter(Limiter limiter, F&& f) {
  switch (limiter) {
    case Limiter::minmod:
      return f(LimiterMinmod{});
    case Limiter::van_leer:
      return f(LimiterVanLeer{});
    case Limiter::mc:
      return f(LimiterMc{});
    case Limiter::superbee:
      return f(LimiterSuperbee{});
    case Limiter::eno:
      break;  // not of this kind: it looks at five cells; the solver refuses it
  }
}

}  // namespace couloir
