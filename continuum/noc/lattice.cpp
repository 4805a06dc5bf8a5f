#include "continuum/noc/lattice.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/isa/clones.hpp"
#include "continuum/noc/share.hpp"
#include "continuum/scheme/effects.hpp"
#include "continuum/scheme/min_max.hpp"

namespace couloir::noc {
namespace {

// Share of a velocity below which its difference to a neighbour is taken for round-off: many times that of some thousand steps,
// and far below what compression makes of the pressure.
constexpr double round_off = 1e-10;

constexpr int own_arrays = 10;  // beside those of the points

int more(Lattice::Kind kind) {
  return kind == Lattice::Kind::corners ? 1 : 0;
}
int size_of(Lattice::Kind kind, const Grid& g) {
  return (g.nx + more(kind) + 2 * Lattice::ghosts) * (g.ny + more(kind) + 2 * Lattice::ghosts);
}

}  // namespace

Lattice::Lattice(Kind kind, const SolverSettings& s, const NocSettings& own, const Terrain& terrain)
    : arrays(Points::arrays + own_arrays, size_of(kind, s.grid)),
      points(arrays),
      locked(arrays.next()),
      kind_(kind),
      s_(s),
      own_(own),
      terrain_(terrain),
      nx_(s.grid.nx + more(kind)),
      ny_(s.grid.ny + more(kind)) {
  for (double** array : {&u_, &v_, &kx_, &ky_, &pull_x_, &pull_y_, &pull_, &lost_x, &lost_y}) *array = arrays.next();
  for (double* k : {kx_, ky_}) std::fill(k, k + size_of(kind, s.grid), 1.0);
  for (int i = 0; i < nx_; ++i) {
    weight_.push_back(middle(i, &Terrain::weight));
    kappa_.push_back(built::curvature ? middle(i, &Terrain::kappa) : 0.0);
  }
  lay_pull();
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

Gradient Lattice::bed_slope(int i, int j) const {
  if (!built::relief || terrain_.level()) return {};
  const auto quarter_at = [&](int a, int b) { return terrain_.slope(inside(quarter(i) + a, 0), inside(quarter(j) + b, 2)); };
  const Gradient ll = quarter_at(0, 0), lh = quarter_at(0, 1), hl = quarter_at(1, 0), hh = quarter_at(1, 1);
  return {0.25 * ((ll.x + lh.x) + (hl.x + hh.x)), 0.25 * ((ll.y + lh.y) + (hl.y + hh.y))};
}

void Lattice::lay_pull() {
  for (int i = 0; i < nx_; ++i) {
    const double drive = middle(i, &Terrain::drive);
    for (int j = 0; j < ny_; ++j) {
      const Gradient bed = bed_slope(i, j);
      const int c = at(i, j);
      pull_x_[c] = drive - weight_[i] * bed.x, pull_y_[c] = -weight_[i] * bed.y;
      pull_[c] = length(pull_x_[c], pull_y_[c]);
    }
  }
}

// Two cells more on each side: for the slopes of the region's velocities.
COULOIR_CLONES void Lattice::find_velocity(const Region& region) {
  const double dry = s_.dry_depth;
  const double *h = q.h, *hu = q.hu, *hv = q.hv;
  double *u = u_, *v = v_;
#pragma omp parallel for num_threads(s_.threads) schedule(static)
  for (int j = region.j0() - ghosts; j < region.j1() + ghosts; ++j) {
    int i0 = nx_, i1 = 0;
    for (int n = std::max(j - ghosts, region.j0()); n <= std::min(j + ghosts, region.j1() - 1); ++n) {
      if (region.begin(n) < region.end(n)) i0 = std::min(i0, region.begin(n)), i1 = std::max(i1, region.end(n));
    }
    const int begin = at(i0 - ghosts, j), end = i0 < i1 ? at(i1 + ghosts, j) : begin;
#pragma omp simd
    for (int c = begin; c < end; ++c) {
      const double wet = h[c] >= dry ? 1.0 : 0.0, per_depth = wet / (wet > 0 ? h[c] : 1.0);
      u[c] = hu[c] * per_depth, v[c] = hv[c] * per_depth;
    }
  }
}

template <bool earth_pressure>
COULOIR_CLONES double Lattice::find_rate(int j, int i0, int i1) {
  const EarthPressure k = s_.closure.earth_pressure;
  const int r = row();
  const double dry = s_.dry_depth, per_dx = 1 / s_.grid.dx, per_dy = 1 / s_.grid.dy;
  const double creep = own_.creeping_froude * own_.creeping_froude;
  const double *h = q.h + at(0, j), *u = u_ + at(0, j), *v = v_ + at(0, j), *weight = weight_.data();
  double *kx = kx_ + at(0, j), *ky = ky_ + at(0, j);
  double fastest = 0;
#pragma omp simd reduction(max : fastest)
  for (int i = i0; i < i1; ++i) {
    const double wet = h[i] >= dry ? 1.0 : 0.0, wave = weight[i] * (wet * h[i]);
    double x = 1, y = 1;
    if constexpr (earth_pressure) {
      // Over two spacings; dry neighbours have no say.
      const double left = h[i - 1] >= dry ? u[i] - u[i - 1] : 0.0, right = h[i + 1] >= dry ? u[i + 1] - u[i] : 0.0;
      const double below = h[i - r] >= dry ? v[i] - v[i - r] : 0.0, above = h[i + r] >= dry ? v[i + r] - v[i] : 0.0;
      // A difference that is round-off has no sign: a mass that slides as one would switch by the toss of a coin.
      // What hardly moves is as good as at rest, and what rests is active.
      const double noise = round_off * (std::abs(u[i]) + std::abs(v[i]));
      const double moving = wet * (u[i] * u[i] + v[i] * v[i] < creep * wave ? 0.0 : 1.0);
      const double du = right + left, dv = above + below;
      const double compressed_x = du < -noise ? moving : 0.0, compressed_y = dv < -noise ? moving : 0.0;
      const double active = compressed_y > 0 ? k.y_passive_active : k.y_active_active;
      const double passive = compressed_y > 0 ? k.y_passive_passive : k.y_active_passive;
      x = compressed_x > 0 ? k.x_passive : k.x_active;
      y = compressed_x > 0 ? passive : active;
      kx[i] = x, ky[i] = y;
    }
    const double rate = larger((std::abs(u[i]) + std::sqrt(x * wave)) * per_dx, (std::abs(v[i]) + std::sqrt(y * wave)) * per_dy);
    fastest = larger(fastest, rate);
  }
  return fastest;
}

double Lattice::find_state(const Region& region) {
  find_velocity(region);
  const bool earth_pressure = built::earth_pressure && !s_.closure.earth_pressure.is_hydraulic();  // else K stays 1
  std::vector<double> rates(std::max(region.j1() - region.j0(), 0), 0.0);
#pragma omp parallel for num_threads(s_.threads) schedule(static)
  for (int j = region.j0(); j < region.j1(); ++j) {
    rates[j - region.j0()] =
        earth_pressure ? find_rate<true>(j, region.begin(j), region.end(j)) : find_rate<false>(j, region.begin(j), region.end(j));
  }
  return rates.empty() ? 0.0 : *std::max_element(rates.begin(), rates.end());
}

void Lattice::wrap_points() {
  const bool along = s_.sides[0].kind == Side::Kind::periodic, across = s_.sides[2].kind == Side::Kind::periodic;
  if (!along && !across) return;
  const auto copy = [&](int from, int to) {
    for (const Three& t : points.threes()) t.h[to] = t.h[from], t.hu[to] = t.hu[from], t.hv[to] = t.hv[from];
    points.reach[to] = points.reach[from], locked[to] = locked[from];
  };
  for (int j = 0; along && j < ny_; ++j) copy(at(nx_ - 1, j), at(-1, j));
  for (int i = -1; across && i < nx_; ++i) copy(at(i, ny_ - 1), at(i, -1));
}

}  // namespace couloir::noc
