#include "continuum/noc/lattice.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/flow/flux.hpp"
#include "continuum/flow/friction.hpp"
#include "continuum/noc/slopes.hpp"
#include "continuum/scheme/effects.hpp"

namespace couloir::noc {
namespace {

// Share of a velocity below which its difference to a neighbour is taken for round-off: many times that of some thousand steps,
// and far below what compression makes of the pressure.
constexpr double round_off = 1e-10;

}  // namespace

Lattice::Lattice(Kind kind, const SolverSettings& s, const NocSettings& own, const Terrain& terrain)
    : kind_(kind),
      s_(s),
      own_(own),
      terrain_(terrain),
      nx_(s.grid.nx + (kind == Kind::corners ? 1 : 0)),
      ny_(s.grid.ny + (kind == Kind::corners ? 1 : 0)) {
  const std::size_t n = static_cast<std::size_t>(row()) * (ny_ + 2 * ghosts);
  q.resize(static_cast<int>(n));
  locked.assign(n, 0);
  points.resize(n);
  for (auto* field : {&u_, &v_}) field->assign(n, 0.0);
  for (auto* field : {&kx_, &ky_}) field->assign(n, 1.0);
  for (int i = 0; i < nx_; ++i) {
    weight_.push_back(middle(i, &Terrain::weight));
    drive_.push_back(middle(i, &Terrain::drive));
    kappa_.push_back(middle(i, &Terrain::kappa));
  }
}

// Beyond the domain's side: the other end where it is periodic, so that twins have the same bits; else the last one.
int Lattice::inside(int quarter, int low_side) const {
  const int n = low_side == 0 ? terrain_.quarters_x() : terrain_.quarters_y();
  if (s_.sides[low_side].kind == Side::Kind::periodic) return (quarter + n) % n;
  return std::clamp(quarter, 0, n - 1);
}

double Lattice::middle(int i, double (Terrain::*value)(int) const) const {
  return 0.5 * ((terrain_.*value)(inside(quarter(i), 0)) + (terrain_.*value)(inside(quarter(i) + 1, 0)));
}

CellBox Lattice::clamp(const CellBox& b) const {
  return {std::max(b.i0, 0), std::min(b.i1, nx_), std::max(b.j0, 0), std::min(b.j1, ny_)};
}

double Lattice::find_state(const CellBox& box) {
  const double dry = s_.dry_depth;
  const int rows = box.j1 - box.j0;
#pragma omp parallel for num_threads(s_.threads) schedule(static)
  for (int j = box.j0 - ghosts; j < box.j1 + ghosts; ++j) {
    for (int c = at(box.i0 - ghosts, j); c < at(box.i1 + ghosts, j); ++c) {
      const bool wet = q.h[c] >= dry;
      u_[c] = wet ? q.hu[c] / q.h[c] : 0.0;
      v_[c] = wet ? q.hv[c] / q.h[c] : 0.0;
    }
  }
  const bool hydraulic = s_.closure.earth_pressure.is_hydraulic();  // K stays 1
  std::vector<double> rates(std::max(rows, 0), 0.0);
#pragma omp parallel for num_threads(s_.threads) schedule(static)
  for (int j = box.j0; j < box.j1; ++j) {
    double rate = 0;
    for (int i = box.i0; i < box.i1; ++i) {
      const int c = at(i, j);
      if (q.h[c] < dry) continue;
      const double wave = weight_[i] * q.h[c];
      if (built::earth_pressure && !hydraulic) find_earth_pressure(c, wave);
      rate = std::max({rate, (std::abs(u_[c]) + std::sqrt(kx_[c] * wave)) / s_.grid.dx,
                       (std::abs(v_[c]) + std::sqrt(ky_[c] * wave)) / s_.grid.dy});
    }
    rates[j - box.j0] = rate;
  }
  return rates.empty() ? 0.0 : *std::max_element(rates.begin(), rates.end());
}

// What K is at a wet point of wave speed sqrt(wave), by the velocities around it.
void Lattice::find_earth_pressure(int c, double wave) {
  const EarthPressure& k = s_.closure.earth_pressure;
  const int r = row();
  const double dry = s_.dry_depth;
  // Over two spacings; dry neighbours have no say.
  const auto difference = [&](const std::vector<double>& w, int s) {
    return (q.h[c + s] >= dry ? w[c + s] - w[c] : 0.0) + (q.h[c - s] >= dry ? w[c] - w[c - s] : 0.0);
  };
  // A difference that is round-off has no sign: a mass that slides as one would switch by the toss of a coin.
  const double noise = round_off * (std::abs(u_[c]) + std::abs(v_[c]));
  const auto above_noise = [&](double d) { return std::abs(d) > noise ? d : 0.0; };
  const double du = above_noise(difference(u_, 1)), dv = above_noise(difference(v_, r));
  // What hardly moves is as good as at rest, and what rests is active.
  const double slowest = own_.creeping_froude * own_.creeping_froude * wave;
  const bool slow = u_[c] * u_[c] + v_[c] * v_[c] < slowest;
  kx_[c] = k.kx(slow ? 0.0 : du);
  ky_[c] = k.ky(slow ? 0.0 : du, slow ? 0.0 : dv);
}

void Lattice::prepare(const CellBox& box, double tau) {
  with_slope(s_.limiter, [&](auto slope) {
#pragma omp parallel for num_threads(s_.threads) schedule(static)
    for (int j = box.j0; j < box.j1; ++j) prepare_row<decltype(slope)>(j, box.i0, box.i1, tau);
  });
}

template <class S>
void Lattice::prepare_row(int j, int i0, int i1, double tau) {
  const int r = row();
  for (int i = i0; i < i1; ++i) {
    const int c = at(i, j);
    Point p;
    p.q = {q.h[c], q.hu[c], q.hv[c]};
    p.x.h = 0.25 * S::slope(&q.h[c], 1);
    p.y.h = 0.25 * S::slope(&q.h[c], r);
    const double drop = std::abs(p.x.h) + std::abs(p.y.h);
    if (drop > p.q.h) {  // the TVD slopes never fall below zero within the cell; ENO's may
      const double fit = p.q.h / drop;
      p.x.h *= fit, p.y.h *= fit;
    }
    if (p.q.h >= s_.dry_depth) {
      const auto slope = [&](const std::vector<double>& momentum, const std::vector<double>& velocity, int s, double rise) {
        if (!own_.velocity_slopes) return 0.25 * S::slope(&momentum[c], s);
        return p.q.h * (0.25 * S::slope(&velocity[c], s)) + velocity[c] * rise;
      };
      p.x.hu = slope(q.hu, u_, 1, p.x.h), p.x.hv = slope(q.hv, v_, 1, p.x.h);
      p.y.hu = slope(q.hu, u_, r, p.y.h), p.y.hv = slope(q.hv, v_, r, p.y.h);
    }
    predict(p, i, j, c, tau);
    points[c] = p;
  }
}

Gradient Lattice::bed_slope(int i, int j) const {
  if (!built::relief || terrain_.level()) return {};
  const auto quarter_at = [&](int a, int b) { return terrain_.slope(inside(quarter(i) + a, 0), inside(quarter(j) + b, 2)); };
  const Gradient ll = quarter_at(0, 0), lh = quarter_at(0, 1), hl = quarter_at(1, 0), hh = quarter_at(1, 1);
  return {0.25 * ((ll.x + lh.x) + (hl.x + hh.x)), 0.25 * ((ll.y + lh.y) + (hl.y + hh.y))};
}

// (3.8) with the Jacobian (3.9); friction may stop the flow here as it may in the corrector.
void Lattice::predict(Point& p, int i, int j, int c, double tau) const {
  const double h = p.q.h, u = u_[c], v = v_[c];
  p.half = {h, 0, 0};
  if (h < s_.dry_depth) return;
  const double weight = weight_[i], gx = kx_[c] * weight, gy = ky_[c] * weight;
  const Gradient bed = bed_slope(i, j);
  const double pull_x = drive_[i] - weight * bed.x, pull_y = -weight * bed.y;
  p.reach = length(u, v) + 2 * std::sqrt(std::max(gx, gy) * h) + tau * length(pull_x, pull_y);

  if (!locked[c]) {
    const double ax = 2 * tau / s_.grid.dx, ay = 2 * tau / s_.grid.dy;  // tau/2 times four quarters by the spacing
    const FlowState &x = p.x, &y = p.y;
    p.half.h = std::max(0.0, h - (ax * x.hu + ay * y.hv));
    const double fx = (gx * h - u * u) * x.h + 2 * u * x.hu, gx_y = -u * v * y.h + v * y.hu + u * y.hv;
    const double fy_x = -u * v * x.h + v * x.hu + u * x.hv, gy_y = (gy * h - v * v) * y.h + 2 * v * y.hv;
    const double hu = p.q.hu - (ax * fx + ay * gx_y) + 0.5 * tau * h * pull_x;
    const double hv = p.q.hv - (ax * fy_x + ay * gy_y) + 0.5 * tau * h * pull_y;
    double left = 1;
    if (built::friction && s_.closure.tan_delta > 0) {
      const double capacity = coulomb_capacity(0.5 * tau, s_.closure.tan_delta, weight, built::curvature ? kappa_[i] : 0.0, u, h);
      left = coulomb_factor(length(hu, hv), capacity);
    }
    p.half.hu = left * hu, p.half.hv = left * hv;
    const double speed = length(p.half.hu, p.half.hv);
    if (p.half.h < s_.dry_depth) p.half.hu = p.half.hv = 0;
    if (speed > p.reach * p.half.h && speed > 0) {
      const double fit = p.reach * p.half.h / speed;
      p.half.hu *= fit, p.half.hv *= fit;
    }
    if (kind_ == Kind::corners) {  // on a wall by symmetry, on an outflow because nothing comes in
      const auto closed = [&](int side, double outward) {
        return s_.sides[side].kind == Side::Kind::wall || (s_.sides[side].kind == Side::Kind::outflow && outward < 0);
      };
      if ((i == 0 && closed(0, -p.half.hu)) || (i == nx_ - 1 && closed(1, p.half.hu))) p.half.hu = 0;
      if ((j == 0 && closed(2, -p.half.hv)) || (j == ny_ - 1 && closed(3, p.half.hv))) p.half.hv = 0;
    }
  }
  const double h2 = p.half.h, u2 = h2 > 0 ? p.half.hu / h2 : 0.0, v2 = h2 > 0 ? p.half.hv / h2 : 0.0;
  const double lx = 0.5 * tau / s_.grid.dx, ly = 0.5 * tau / s_.grid.dy;
  const FaceFlux f = flux_x(h2, u2, v2, gx), g = flux_y(h2, u2, v2, gy);
  p.flux_x = {lx * f.mass, lx * f.mom_x, lx * f.mom_y};
  p.flux_y = {ly * g.mass, ly * g.mom_x, ly * g.mom_y};
}

}  // namespace couloir::noc
