#include "continuum/scheme/rest.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/scheme/effects.hpp"
namespace couloir {
namespace {

struct Slope {
  bool exists = false;
  double surface = 0, bed = 0;  // difference to the neighbour in the direction of the axis [m]
  double head = 0;              // of K h^2 / 2 over the mean depth, likewise, with the K of both
};

// Of the earth pressure: from active to what the cell has mobilised.
struct Range {
  double least, most;
};

class RestTest {
 public:
  RestTest(const Parameters& p, const Block& b, const BlockState& s, const Scratch& w)
      : p_(p), b_(b), q_(s.now), w_(w), mu_(p.closure.tan_delta * (1 + 1e-12)) {}

  bool locked(int i, int j) const {
    const int c = b_.at(i, j);
    if (q_.h[c] < p_.dry_depth) return true;
    if (q_.hu[c] != 0 || q_.hv[c] != 0) return false;
    const int gi = b_.i0 + i, gj = b_.j0 + j, row = b_.row();
    const Range kx{p_.closure.earth_pressure.x_active, w_.kx[c]}, ky{p_.closure.earth_pressure.y_active_active, w_.ky[c]};
    const Slope x_lo = slope(c, c - 1, w_.kx, gi == 0 && wall(0)), x_hi = slope(c, c + 1, w_.kx, gi == b_.grid.nx - 1 && wall(1));
    const Slope y_lo = slope(c, c - row, w_.ky, gj == 0 && wall(2)),
                y_hi = slope(c, c + row, w_.ky, gj == b_.grid.ny - 1 && wall(3));
    double fx = 0, fy = 0;
    return holds(x_lo, x_hi, b_.tan_zeta[i + Block::ghosts], kx, b_.grid.dx, fx) && holds(y_lo, y_hi, 0, ky, b_.grid.dy, fy) &&
           fx * fx + fy * fy <= mu_ * mu_;
  }

 private:
  bool wall(int side) const { return p_.wall(side); }

  Slope slope(int c, int n, const Values& k, bool closed) const {
    if (closed) return {};
    const double to_neighbour = n > c ? 1.0 : -1.0;
    const double bed = to_neighbour * (b_.bed[n] - b_.bed[c]);
    const double head_c = q_.h[c] + b_.bed[c], head_n = q_.h[n] + b_.bed[n];
    if (b_.top[n] == b_.top[c]) {
      if (b_.bed[n] - b_.bed[c] >= k[c] * q_.h[c]) return {};
      const double h = q_.h[c], beyond = q_.h[n], head = (k[n] * beyond * beyond - k[c] * h * h) / (beyond + h);
      return {true, to_neighbour * (head_n - head_c), bed, to_neighbour * head};
    }
    const double sill = std::max(b_.bed[c] + b_.top[c], b_.bed[n] + b_.top[n]);
    const double over_c = head_c + b_.top[c] - sill, over_n = std::max(0.0, head_n + b_.top[n] - sill);
    if (over_c <= 0) return {};
    const double over = to_neighbour * (over_n - over_c);
    return {true, over, bed, k[c] * over};
  }

  // Each one-sided driving force is within friction, with the states of both cells or with some other state of this one's range;
  // force: their mean. Between two closed sides nothing can move.
  bool holds(const Slope& lo, const Slope& hi, double drive, const Range& k, double spacing, double& force) const {
    const auto driving = [&](const Slope& s) {
      const auto with = [&](double k) { return drive - (k * s.surface + (1 - k) * s.bed) / spacing; };
      const auto [least, most] = std::minmax({with(k.least), with(k.most), drive - (s.head + s.bed) / spacing});
      return std::clamp(0.0, least, most);
    };
    if (!lo.exists && !hi.exists) return true;
    // What drives it against a closed side is held there.
    const double a = lo.exists ? driving(lo) : std::max(0.0, driving(hi)),
                 b = hi.exists ? driving(hi) : std::min(0.0, driving(lo));
    if (!lo.exists || !hi.exists) return std::abs(force = lo.exists ? b : a) <= mu_;
    force = 0.5 * (a + b);
    return std::abs(a) <= mu_ && std::abs(b) <= mu_;
  }

  const Parameters& p_;
  const Block& b_;
  const Fields& q_;
  const Scratch& w_;
  double mu_;
};

// A ghost outside of the domain stands for the cell inside.
void copy_from_inside(const Parameters& p, const Block& b, Values& loose) {
  const auto outside = [&](int side) { return p.wall(side) || p.sides[side].kind == Side::Kind::outflow; };
  for (int j = 0; j < b.ny; ++j) {
    if (b.i0 == 0 && outside(0)) loose[b.at(-1, j)] = loose[b.at(0, j)];
    if (b.i0 + b.nx == b.grid.nx && outside(1)) loose[b.at(b.nx, j)] = loose[b.at(b.nx - 1, j)];
  }
  for (int i = 0; i < b.nx; ++i) {
    if (b.j0 == 0 && outside(2)) loose[b.at(i, -1)] = loose[b.at(i, 0)];
    if (b.j0 + b.ny == b.grid.ny && outside(3)) loose[b.at(i, b.ny)] = loose[b.at(i, b.ny - 1)];
  }
}

// Dry cells are locked. Returns whether wet ones without momentum are among the others, if that is asked.
template <bool ask>
bool find_dry(const Parameters& p, const Block& b, const BlockState& s, double* loose, int j) {
  const double *h = s.now.h.data(), *hu = s.now.hu.data(), *hv = s.now.hv.data(), *open = s.open.data(), dry = p.dry_depth;
  const int begin = b.at(-1, j), end = b.at(b.nx, j);
  double still = 0;
#pragma omp simd reduction(+ : still)
  for (int c = begin; c <= end; ++c) {
    const bool wet = !(open[c] == 1 && h[c] < dry);
    loose[c] = wet ? 1.0 : 0.0;
    if constexpr (ask) still += wet && hu[c] == 0 && hv[c] == 0 ? 1.0 : 0.0;
  }
  return still > 0;
}

}  // namespace

void find_locked(const Parameters& p, const Block& b, const BlockState& s, Scratch& w) {
  w.locked = w.still;
  if (!w.locked) {
    std::fill_n(w.loose.begin(), b.size(), 1.0);
    return;
  }
  const RestTest test(p, b, s, w);
  double* loose = w.loose.data();
  for (int j = -1; j <= b.ny; ++j) {
    // Without friction nothing else is locked.
    const bool still = with_friction(p) ? find_dry<built::friction>(p, b, s, loose, j) : find_dry<false>(p, b, s, loose, j);
    for (int i = -1; still && i <= b.nx; ++i) {
      const int c = b.at(i, j);
      if (s.open[c] == 1 && test.locked(i, j)) loose[c] = 0;
    }
  }
  copy_from_inside(p, b, w.loose);
}

}  // namespace couloir
