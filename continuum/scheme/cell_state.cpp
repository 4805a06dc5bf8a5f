#include "continuum/scheme/cell_state.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/scheme/effects.hpp"

namespace couloir {
namespace {

// The fall of the velocity over two depths, or over a cell's two neighbours where these are farther apart, as a share of
// sqrt(g cos(zeta) h), that mobilises all of the passive state. docs/decisions/0004.
constexpr double mobilisation = 0.2;

// Slower than this Froude number nothing counts as compressed: else a deposit trembles between the two states and never rests.
constexpr double creeping = 0.01;

// Share of the passive state for a velocity difference du over two cells.
inline double passive_share(double du, double h, double spacing, double wave_speed, bool moves) {
  const double share = std::min(std::max(-du, 0.0) * std::max(h, spacing) / (mobilisation * spacing * wave_speed), 1.0);
  return moves ? share : 0.0;
}

inline double wave_speed(double h, double weight) {
  return std::max(std::sqrt(weight * std::max(h, 0.0)), 1e-30);
}

// Sum of the two one-sided velocity differences of cell c along an axis of this step.
double stretching(const Parameters& p, const Block& b, const Fields& q, const std::vector<double>& u, int c, int step) {
  const auto difference = [&](int n) {
    const double to_neighbour = n > c ? 1.0 : -1.0;
    const bool wall = b.top[n] > b.top[c] && q.h[c] + b.bed[c] + b.top[c] <= b.bed[n] + b.top[n];
    if (wall) return to_neighbour * (-u[c] - u[c]);
    return q.h[n] >= p.dry_depth ? to_neighbour * (u[n] - u[c]) : 0.0;
  };
  return difference(c + step) + difference(c - step);
}

}  // namespace

void find_velocity(const Parameters& p, const Block& b, const Fields& q, Scratch& w) {
  const double *h = q.h.data(), *hu = q.hu.data(), *hv = q.hv.data(), *bed = b.bed.data();
  double *u = w.u.data(), *v = w.v.data(), *eta = w.eta.data();
  const double dry = p.dry_depth;
  const int n = b.size();
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const bool wet = h[c] >= dry;
    const double depth = wet ? h[c] : 1.0;
    u[c] = wet ? hu[c] / depth : 0.0;
    v[c] = wet ? hv[c] / depth : 0.0;
  }
  if (with_relief(b)) {
#pragma omp simd
    for (int c = 0; c < n; ++c) eta[c] = h[c] + bed[c];
  }
}

void find_earth_pressure(const Parameters& p, const Block& b, const StepFaces& steps, const Fields& q, Scratch& w) {
  if (!with_earth_pressure(p)) return;  // K = 1, as Scratch::resize() left it
  const EarthPressure k = p.closure.earth_pressure;
  const int row = b.row();
  const double dry = p.dry_depth, dx = p.grid.dx, dy = p.grid.dy;
  const double *h = q.h.data(), *u = w.u.data(), *v = w.v.data();
  double *kx = w.kx.data(), *ky = w.ky.data();
  for (int j = -1; j <= b.ny; ++j) {
    const int begin = b.at(-1, j), end = b.at(b.nx, j);
#pragma omp simd
    for (int c = begin; c <= end; ++c) {
      const double du = (h[c + 1] >= dry ? u[c + 1] - u[c] : 0.0) + (h[c - 1] >= dry ? u[c] - u[c - 1] : 0.0);
      const double dv = (h[c + row] >= dry ? v[c + row] - v[c] : 0.0) + (h[c - row] >= dry ? v[c] - v[c - row] : 0.0);
      const double speed = wave_speed(h[c], b.weight[c - begin + Block::ghosts - 1]);
      const bool moves = u[c] * u[c] + v[c] * v[c] > creeping * creeping * speed * speed;
      const double x = passive_share(du, h[c], dx, speed, moves), y = passive_share(dv, h[c], dy, speed, moves);
      kx[c] = k.kx_mobilised(x);
      ky[c] = k.ky_mobilised(x, y);
    }
  }
  for (int c : steps.cells) {
    const double du = stretching(p, b, q, w.u, c, 1), dv = stretching(p, b, q, w.v, c, row);
    const double speed = wave_speed(h[c], b.weight[c % row]);
    const bool moves = u[c] * u[c] + v[c] * v[c] > creeping * creeping * speed * speed;
    const double x = passive_share(du, h[c], dx, speed, moves), y = passive_share(dv, h[c], dy, speed, moves);
    kx[c] = k.kx_mobilised(x);
    ky[c] = k.ky_mobilised(x, y);
  }
}

}  // namespace couloir
