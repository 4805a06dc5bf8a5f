// Slopes (3.18)-(3.21), predictor (3.8) and fluxes of a lattice.

#include <algorithm>
#include <cmath>

#include "continuum/flow/flux.hpp"
#include "continuum/flow/friction.hpp"
#include "continuum/isa/clones.hpp"
#include "continuum/noc/lattice.hpp"
#include "continuum/noc/share.hpp"
#include "continuum/noc/slopes.hpp"
#include "continuum/scheme/effects.hpp"
#include "continuum/scheme/min_max.hpp"

namespace couloir::noc {
namespace {

constexpr double just_below = 1 - 1e-12;  // so that round-off leaves no share below zero

// Three arrays from a point on.
struct Row {
  double *h, *hu, *hv;
  Row(const Three& t, int c) : h(t.h + c), hu(t.hu + c), hv(t.hv + c) {}
};

}  // namespace

template <class S, bool velocity_slopes>
COULOIR_CLONES void Lattice::find_slopes(int j, int i0, int i1) {
  const int r = row(), begin = at(0, j);
  const double dry = s_.dry_depth;
  const double *h = q.h + begin, *u = u_ + begin, *v = v_ + begin;
  const double *wu = velocity_slopes ? u : q.hu + begin, *wv = velocity_slopes ? v : q.hv + begin;
  const Row x(points.x, begin), y(points.y, begin);
#pragma omp simd
  for (int i = i0; i < i1; ++i) {
    double xh = 0.25 * S::slope(h + i, 1), yh = 0.25 * S::slope(h + i, r);
    // The TVD slopes never fall below zero within the cell; ENO's may.
    const double drop = std::abs(xh) + std::abs(yh), fit = drop > h[i] ? just_below * h[i] / drop : 1.0;
    xh *= fit, yh *= fit;
    const double wet = h[i] >= dry ? 1.0 : 0.0;
    double xhu = 0.25 * S::slope(wu + i, 1), xhv = 0.25 * S::slope(wv + i, 1);
    double yhu = 0.25 * S::slope(wu + i, r), yhv = 0.25 * S::slope(wv + i, r);
    if constexpr (velocity_slopes) {
      xhu = h[i] * xhu + u[i] * xh, xhv = h[i] * xhv + v[i] * xh;
      yhu = h[i] * yhu + u[i] * yh, yhv = h[i] * yhv + v[i] * yh;
    }
    x.h[i] = xh, x.hu[i] = wet * xhu, x.hv[i] = wet * xhv;
    y.h[i] = yh, y.hu[i] = wet * yhu, y.hv[i] = wet * yhv;
  }
}

// (3.8) with the Jacobian (3.9); friction may stop the flow here as it may in the corrector. What is locked or dry stays as it
// is.
template <bool friction>
COULOIR_CLONES void Lattice::predict(int j, int i0, int i1, double tau) {
  const int begin = at(0, j);
  const double dry = s_.dry_depth, mu = s_.closure.tan_delta;
  const double ax = 2 * tau / s_.grid.dx, ay = 2 * tau / s_.grid.dy;  // tau/2 times four quarters by the spacing
  const double lx = 0.5 * tau / s_.grid.dx, ly = 0.5 * tau / s_.grid.dy;
  const double *qh = q.h + begin, *qhu = q.hu + begin, *qhv = q.hv + begin;
  const double *us = u_ + begin, *vs = v_ + begin, *kx = kx_ + begin, *ky = ky_ + begin;
  const double *still = locked + begin, *weights = weight_.data(), *kappas = kappa_.data();
  const double *pull_x = pull_x_ + begin, *pull_y = pull_y_ + begin, *pull = pull_ + begin;
  const Row x(points.x, begin), y(points.y, begin), half(points.half, begin), tilt_x(points.tilt_x, begin),
      tilt_y(points.tilt_y, begin);
  double* reaches = points.reach + begin;
#pragma omp simd
  for (int i = i0; i < i1; ++i) {
    const double h = qh[i], u = us[i], v = vs[i], gx = kx[i] * weights[i], gy = ky[i] * weights[i];
    const double xh = x.h[i], xhu = x.hu[i], xhv = x.hv[i], yh = y.h[i], yhu = y.hu[i], yhv = y.hv[i];
    const double wet = h >= dry ? 1.0 : 0.0, free = wet * (1 - still[i]);
    const double reach = wet * (length(u, v) + 2 * std::sqrt(larger(gx, gy) * (wet * h)) + tau * pull[i]);

    const double fx = (gx * h - u * u) * xh + 2 * u * xhu, gx_y = -u * v * yh + v * yhu + u * yhv;
    const double fy_x = -u * v * xh + v * xhu + u * xhv, gy_y = (gy * h - v * v) * yh + 2 * v * yhv;
    const double h2 = free > 0 ? larger(0.0, h - (ax * xhu + ay * yhv)) : h;
    const double hu = qhu[i] - (ax * fx + ay * gx_y) + 0.5 * tau * h * pull_x[i];
    const double hv = qhv[i] - (ax * fy_x + ay * gy_y) + 0.5 * tau * h * pull_y[i];
    const double momentum = length(hu, hv);
    double left = h2 >= dry ? free : 0.0;
    if constexpr (friction) left *= coulomb_factor(momentum, coulomb_capacity(0.5 * tau, mu, weights[i], kappas[i], u, h));
    const double most = reach * h2, size = left * momentum;
    left *= size > most ? most / (size > 0 ? size : 1.0) : 1.0;
    const double hu2 = left * hu, hv2 = left * hv, per_depth = 1 / (h2 > 0 ? h2 : 1.0);

    // A film has no pressure: it would push on what is not looked at.
    const double u2 = hu2 * per_depth, v2 = hv2 * per_depth;
    const FaceFlux f = flux_x(h2, u2, v2, wet * gx), g = flux_y(h2, u2, v2, wet * gy);
    half.h[i] = h2, half.hu[i] = hu2, half.hv[i] = hv2;
    tilt_x.h[i] = 0.25 * xh + lx * f.mass, tilt_x.hu[i] = 0.25 * xhu + lx * f.mom_x, tilt_x.hv[i] = 0.25 * xhv + lx * f.mom_y;
    tilt_y.h[i] = 0.25 * yh + ly * g.mass, tilt_y.hu[i] = 0.25 * yhu + ly * g.mom_x, tilt_y.hv[i] = 0.25 * yhv + ly * g.mom_y;
    reaches[i] = reach;
  }
}

void Lattice::prepare(const Region& region, double tau) {
  const bool friction = built::friction && s_.closure.tan_delta > 0;
  with_slope(s_.limiter, [&](auto slope) {
    using S = decltype(slope);
#pragma omp parallel for num_threads(s_.threads) schedule(static)
    for (int j = region.j0(); j < region.j1(); ++j) {
      const int i0 = region.begin(j), i1 = region.end(j);
      own_.velocity_slopes ? find_slopes<S, true>(j, i0, i1) : find_slopes<S, false>(j, i0, i1);
      friction ? predict<true>(j, i0, i1, tau) : predict<false>(j, i0, i1, tau);
      if (kind_ == Kind::corners) close_sides(j, i0, i1, tau);
    }
  });
}

// Corners on the domain's sides: nothing crosses a wall, by symmetry, and nothing comes in through an outflow.
void Lattice::close_sides(int j, int i0, int i1, double tau) {
  const auto closed = [&](int side, double outward) {
    return s_.sides[side].kind == Side::Kind::wall || (s_.sides[side].kind == Side::Kind::outflow && outward < 0);
  };
  const double lx = 0.5 * tau / s_.grid.dx, ly = 0.5 * tau / s_.grid.dy;
  const auto close = [&](int i) {
    const int c = at(i, j);
    double &hu = points.half.hu[c], &hv = points.half.hv[c];
    const bool x = (i == 0 && closed(0, -hu)) || (i == nx_ - 1 && closed(1, hu));
    const bool y = (j == 0 && closed(2, -hv)) || (j == ny_ - 1 && closed(3, hv));
    if (!(x && hu != 0) && !(y && hv != 0)) return;
    if (x) hu = 0;
    if (y) hv = 0;
    const double h = points.half.h[c], u = h > 0 ? hu / h : 0.0, v = h > 0 ? hv / h : 0.0;
    const FaceFlux f = flux_x(h, u, v, kx_[c] * weight_[i]), g = flux_y(h, u, v, ky_[c] * weight_[i]);
    const auto tilt = [](const Three& to, const Three& slope, int c, double l, const FaceFlux& flux) {
      to.h[c] = 0.25 * slope.h[c] + l * flux.mass;
      to.hu[c] = 0.25 * slope.hu[c] + l * flux.mom_x;
      to.hv[c] = 0.25 * slope.hv[c] + l * flux.mom_y;
    };
    tilt(points.tilt_x, points.x, c, lx, f), tilt(points.tilt_y, points.y, c, ly, g);
  };
  if (j == 0 || j == ny_ - 1) {
    for (int i = i0; i < i1; ++i) close(i);
  } else {
    if (i0 == 0 && i1 > 0) close(0);
    if (i1 == nx_ && i0 < i1) close(nx_ - 1);
  }
}

}  // namespace couloir::noc
