#include "continuum/scheme/mobilisation.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/scheme/effects.hpp"

namespace couloir {
namespace {

// Sum of the two one-sided velocity differences of cell c along an axis of this step.
double stretching(const Parameters& p, const Block& b, const Fields& q, const Values& u, int c, int step) {
  const auto difference = [&](int n) {
    const double to_neighbour = n > c ? 1.0 : -1.0;
    const bool wall = b.top[n] > b.top[c] && q.h[c] + b.bed[c] + b.top[c] <= b.bed[n] + b.top[n];
    if (wall) return to_neighbour * (-u[c] - u[c]);
    return q.h[n] >= p.dry_depth ? to_neighbour * (u[n] - u[c]) : 0.0;
  };
  return difference(c + step) + difference(c - step);
}

}  // namespace

void mobilise(const Parameters& p, const Block& b, const StepFaces& steps, BlockState& s, Scratch& w, double dt) {
  if (!with_earth_pressure(p) || dt == 0) return;
  // K is not known yet: its arrays hold the shares of before.
  std::copy(s.passive_x.begin(), s.passive_x.end(), w.kx.begin());
  std::copy(s.passive_y.begin(), s.passive_y.end(), w.ky.begin());
  const int row = b.row();
  const double dry = p.dry_depth, per_dx = dt / b.grid.dx, per_dy = dt / b.grid.dy;
  const double *h = s.now.h.data(), *u = w.u.data(), *v = w.v.data(), *old_x = w.kx.data(), *old_y = w.ky.data();
  double *x = s.passive_x.data(), *y = s.passive_y.data();

  const auto carry_on = [=](int c, double du, double dv) {
    // From upwind, where something is.
    const auto carried = [=](const double* share, double courant, int step) {
      const double lower = h[c - step] >= dry ? share[c - step] - share[c] : 0.0;
      const double upper = h[c + step] >= dry ? share[c + step] - share[c] : 0.0;
      return std::max(courant, 0.0) * lower + std::max(-courant, 0.0) * upper;
    };
    const double ux = per_dx * u[c], vy = per_dy * v[c], half = 0.5 / passive_strain;
    const double new_x = old_x[c] + carried(old_x, ux, 1) + carried(old_x, vy, row) - half * per_dx * du;
    const double new_y = old_y[c] + carried(old_y, ux, 1) + carried(old_y, vy, row) - half * per_dy * dv;
    const bool wet = h[c] >= dry;
    x[c] = wet ? std::min(std::max(new_x, 0.0), 1.0) : 0.0;
    y[c] = wet ? std::min(std::max(new_y, 0.0), 1.0) : 0.0;
  };
  for (int j = 0; j < b.ny; ++j) {
    const int begin = b.at(0, j), end = b.at(b.nx, j);
#pragma omp simd
    for (int c = begin; c < end; ++c) {
      const double du = (h[c + 1] >= dry ? u[c + 1] - u[c] : 0.0) + (h[c - 1] >= dry ? u[c] - u[c - 1] : 0.0);
      const double dv = (h[c + row] >= dry ? v[c + row] - v[c] : 0.0) + (h[c - row] >= dry ? v[c] - v[c - row] : 0.0);
      carry_on(c, du, dv);
    }
  }
  for (int c : steps.cells) carry_on(c, stretching(p, b, s.now, w.u, c, 1), stretching(p, b, s.now, w.v, c, row));
}

void find_earth_pressure(const Parameters& p, const Block& b, const BlockState& s, Scratch& w) {
  if (!with_earth_pressure(p)) return;  // K = 1, as Scratch::resize() left it
  const EarthPressure k = p.closure.earth_pressure;
  const double *x = s.passive_x.data(), *y = s.passive_y.data();
  double *kx = w.kx.data(), *ky = w.ky.data();
  const int n = b.size();
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    kx[c] = k.kx_mobilised(x[c]);
    ky[c] = k.ky_mobilised(x[c], y[c]);
  }
}

}  // namespace couloir
