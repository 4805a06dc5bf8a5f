// The rest test, before the averaging: a cell that lies still and is held by friction is locked. A corner between four locked
// cells gives back to each what it got, so that a deposit is not smeared; a cell between four such corners keeps every bit.
// The same test as that of the central-upwind scheme (scheme/rest.cpp).

#include <cmath>

#include "continuum/noc/noc_impl.hpp"

namespace couloir {
namespace {

struct Slope {
  bool exists = false;
  double rise = 0;  // K dh + dz_b to the neighbour, in the direction of the axis [m]
};

// Each one-sided driving force is within friction; force: their mean. Between two closed sides nothing can move.
bool holds(const Slope& low, const Slope& high, double drive, double spacing, double mu, double& force) {
  const auto driving = [&](const Slope& s) { return drive - s.rise / spacing; };
  if (!low.exists && !high.exists) return true;
  const double a = low.exists ? driving(low) : driving(high), b = high.exists ? driving(high) : driving(low);
  force = 0.5 * (a + b);
  return std::abs(a) <= mu && std::abs(b) <= mu;
}

}  // namespace

// Few cells that are wet are at rest: they are looked at one by one.
void NocSolver::Impl::find_locked() {
  const double dry = settings.dry_depth;
  const bool friction = settings.closure.tan_delta > 0;
#pragma omp parallel for num_threads(settings.threads) schedule(static)
  for (int j = around.j0(); j < around.j1(); ++j) {
    const int begin = centres.at(around.begin(j), j), end = centres.at(around.end(j), j), shift = centres.at(0, j);
    const double *h = centres.q.h, *hu = centres.q.hu, *hv = centres.q.hv;
    double* locked_at = centres.locked;
    double resting = 0;
#pragma omp simd reduction(+ : resting)
    for (int c = begin; c < end; ++c) {
      const double film = h[c] < dry ? 1.0 : 0.0, still = std::abs(hu[c]) + std::abs(hv[c]) == 0 ? 1.0 : 0.0;
      locked_at[c] = film;
      resting += (1 - film) * still;
    }
    if (!friction || resting == 0) continue;
    for (int c = begin; c < end; ++c) {
      if (hu[c] == 0 && hv[c] == 0) locked_at[c] = locked(c - shift, j);
    }
  }
}

bool NocSolver::Impl::locked(int i, int j) const {
  const int c = centres.at(i, j);
  const double h = centres.q.h[c], mu = settings.closure.tan_delta * (1 + 1e-12);
  if (h < settings.dry_depth) return true;
  if (centres.q.hu[c] != 0 || centres.q.hv[c] != 0 || !(mu > 0)) return false;
  const Grid& g = settings.grid;
  const double bed = terrain.height(i, j);
  bool beside_inflow = false;
  // Slope to the neighbour n cells on along an axis; k: earth pressure.
  const auto slope = [&](int at, int cells, int n, int low_side, double k, const auto& place) -> Slope {
    int to = at + n;
    if (to < 0 || to >= cells) {
      switch (settings.sides[n < 0 ? low_side : low_side + 1].kind) {
        case Side::Kind::wall:
          return {};
        case Side::Kind::outflow:
          return {true, 0};
        case Side::Kind::inflow:
          beside_inflow = true;
          return {};
        case Side::Kind::periodic:
          to = (to + cells) % cells;
      }
    }
    const auto [ni, nj] = place(to);
    const double nh = centres.q.h[centres.at(ni, nj)], rise = terrain.height(ni, nj) - bed;
    if (nh < settings.dry_depth && rise >= h) return {};  // a dry bank above the surface
    return {true, n * (k * (nh - h) + rise)};
  };
  const auto along_x = [&](int to) { return std::pair{to, j}; };
  const auto along_y = [&](int to) { return std::pair{i, to}; };
  const double kx = centres.kx(c), ky = centres.ky(c), drive = terrain.drive(2 * i) / terrain.weight(2 * i);
  const double other = terrain.drive(2 * i + 1) / terrain.weight(2 * i + 1);
  const Slope x_low = slope(i, g.nx, -1, 0, kx, along_x), x_high = slope(i, g.nx, 1, 0, kx, along_x);
  const Slope y_low = slope(j, g.ny, -1, 2, ky, along_y), y_high = slope(j, g.ny, 1, 2, ky, along_y);
  if (beside_inflow) return false;
  double fx = 0, fy = 0;
  return holds(x_low, x_high, 0.5 * (drive + other), g.dx, mu, fx) && holds(y_low, y_high, 0, g.dy, mu, fy) &&
         fx * fx + fy * fy <= mu * mu;
}

}  // namespace couloir
