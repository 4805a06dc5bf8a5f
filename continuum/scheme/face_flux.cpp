#include "continuum/scheme/face_flux.hpp"

#include <cmath>
#include <type_traits>

#include "continuum/scheme/effects.hpp"
#include "continuum/scheme/hll.hpp"
#include "continuum/scheme/min_max.hpp"

namespace couloir {
namespace {

// Share in which a rise is a wall to what runs at it: none while the head K h reaches over it, all from twice the head on; and
// none up to 45 deg, where material runs up as on any slope, all from a slope of 2 on.
inline double wall_share(double rise, double head, double spacing) {
  const double above = smaller(larger(0.0, rise - head) / larger(head, 1e-300), 1.0);
  return above * smaller(larger(0.0, rise / spacing - 1), 1.0);
}

// What a slope's foot gives to a flow that it cannot hold by pressure: where the bed blocks the way down (h* < h reaches over),
// the weight of the cell's material asks for a depth of 2 dx tan(zeta); a thinner flow meets a wall there, in proportion. The
// square keeps the second order where the rise is small. Only the speed gained counts, beyond half of what follows: a flow that
// keeps coming runs up. (Beyond all of it, thin films on steep wavy beds gain energy.)
inline double foot(double h, double over, double gained, double weight, double deep) {
  const double blocked = h > 0 ? 1 - over / h : 0.0, thin = h < deep ? 1 - h / deep : 0.0;
  return blocked * blocked * thin * (wall_flux(h, larger(gained, 0.0), weight) - pressure(h, weight));
}

// What the answer of K to strain asks of a face beyond HLL, which knows the waves of K h alone: both sides' velocities even out
// at the faster speed, where K can still follow. Else nothing damps those waves. c: the slower wave of both sides.
inline double resistance(double compression, double h, double c, double stiffness, double weight, double least, double most) {
  const double speed = std::sqrt(c * c + stiffness * weight * h) - c;
  const double room = compression > 0 ? 1 - least : most;
  return room > 0 ? 0.5 * h * speed * compression : 0.0;
}

// Without relief h* = h and the bed does not push: the same bits for less work.
template <bool relief, bool one_flux, bool flattening, bool elastic>
void fluxes(const Block& b, const Axis& axis, double dry, const Scratch& w, const FaceValues& f) {
  const int step = axis.step;
  FaceFluxes& out = *axis.fluxes;
  const double *h_lo = f.h_lo.data(), *h_hi = f.h_hi.data(), *eta_lo = f.eta_lo.data(), *eta_hi = f.eta_hi.data();
  const double *un_lo = f.un_lo.data(), *un_hi = f.un_hi.data(), *ut_lo = f.ut_lo.data(), *ut_hi = f.ut_hi.data();
  const double spacing = axis.spacing;
  const double stiffness = axis.stiffness, *passive = axis.passive;
  const double *h = axis.h, *un = axis.un, *k = axis.k, *loose = w.loose.data(), *smooth = w.smooth.data();
  double *mass = out.mass.data(), *tangent = out.tangent.data(), *normal = out.normal.data();
  double *below = out.normal_below.data(), *above = out.normal_above.data();
  for (int j = 0; j < axis.faces_j; ++j) {
    const int begin = b.at(0, j);
    const double *weight = axis.weight + Block::ghosts, *deep = axis.foot_depth + Block::ghosts;
#pragma omp simd
    for (int i = 0; i < axis.faces_i; ++i) {
      const int r = begin + i, l = r - step;
      const double kl = elastic ? k[l] : 1.0, kr = elastic ? k[r] : 1.0;
      const double gl = kl * weight[i], gr = kr * weight[i];
      const double hl = h_hi[l], hr = h_lo[r];
      double over_l = hl, over_r = hr;
      if constexpr (relief) {
        const double zl = eta_hi[l] - hl, zr = eta_lo[r] - hr, sill = larger(zl, zr);
        // h - (sill - z) / K, written so that K = 1 keeps the bits of a lake's level.
        over_l = larger(0.0, smaller(hl, (eta_hi[l] - sill) + (1 - 1 / kl) * (sill - zl)));
        over_r = larger(0.0, smaller(hr, (eta_lo[r] - sill) + (1 - 1 / kr) * (sill - zr)));
      }
      NormalFlux n = hll(over_l, un_hi[l], gl, over_r, un_lo[r], gr, flattening && smooth[l] * smooth[r] == 0);
      if constexpr (elastic) {
        n.momentum +=
            resistance(un_hi[l] - un_lo[r], smaller(over_l, over_r), smaller(std::sqrt(gl * over_l), std::sqrt(gr * over_r)),
                       stiffness, weight[i], smaller(passive[l], passive[r]), larger(passive[l], passive[r]));
      }
      const double m = one_flux ? n.mass : n.mass * larger(loose[l], loose[r]);
      mass[r] = m;
      tangent[r] = m * (m > 0 ? ut_hi[l] : ut_lo[r]);
      normal[r] = n.momentum;
      double push_l = 0, push_r = 0;
      if constexpr (relief) {
        const double zl = eta_hi[l] - hl, zr = eta_lo[r] - hr, sill = larger(zl, zr);
        const double turned_l = wall_share(sill - zl, kl * hl, spacing) * (wall_flux(hl, un_hi[l], gl) - pressure(hl, gl));
        const double turned_r = wall_share(sill - zr, kr * hr, spacing) * (wall_flux(hr, -un_lo[r], gr) - pressure(hr, gr));
        const double gained = un_hi[l] - 0.5 * larger(un[l - step], 0.0);
        const double blocked = foot(hl, over_l, gained, weight[i], deep[i]);
        push_l = (pressure(hl, gl) - pressure(over_l, gl)) + (un_hi[l] > 0 ? larger(turned_l, blocked) : turned_l);
        push_r = (pressure(hr, gr) - pressure(over_r, gr)) + turned_r;
      }
      if constexpr (!one_flux) {
        const double films = h[l] < dry && h[r] < dry ? 0.0 : 1.0;
        normal[r] *= films;
        below[r] = films * (n.momentum + push_l);
        above[r] = films * (n.momentum + push_r);
      }
    }
  }
}

}  // namespace

void flatten_at_feet(const Block& b, const Axis& axis, const Fields& q, Values& smooth) {
  const int step = axis.step;
  const double spacing = axis.spacing;
  const double *h = q.h.data(), *bed = b.bed.data(), *k = axis.k;
  double* s = smooth.data();
  for (int j = axis.first_j(); j < axis.faces_j; ++j) {
    const int begin = b.at(axis.first_i(), j), end = b.at(axis.faces_i, j);
#pragma omp simd
    for (int c = begin; c < end; ++c) {
      const double lo = bed[c - step] - bed[c], hi = bed[c + step] - bed[c], reach = larger(k[c] * h[c], spacing);
      const bool foot = (lo > reach && lo + 2 * hi > 0) || (hi > reach && hi + 2 * lo > 0);
      s[c] = foot ? 0.0 : s[c];
    }
  }
}

void face_fluxes(const Parameters& p, const Block& b, const Axis& axis, const Scratch& w, const FaceValues& f) {
  const auto with = [](bool yes, auto&& run) { yes ? run(std::true_type()) : run(std::false_type()); };
  with(with_earth_pressure(p), [&]<bool elastic>(std::bool_constant<elastic>) {
    constexpr bool k = elastic && built::earth_pressure;
    if (with_relief(b)) return fluxes<built::relief, false, built::all, k>(b, axis, p.dry_depth, w, f);
    with(with_friction(p), [&]<bool friction>(std::bool_constant<friction>) {
      constexpr bool flattening = friction && built::friction;
      w.one_flux ? fluxes<false, true, flattening, k>(b, axis, p.dry_depth, w, f)
                 : fluxes<false, false, flattening, k>(b, axis, p.dry_depth, w, f);
    });
  });
}

void bed_source(const Block& b, const Axis& axis, const FaceValues& f) {
  const double per_spacing = 1 / axis.spacing;
  const double *h_lo = f.h_lo.data(), *h_hi = f.h_hi.data(), *eta_lo = f.eta_lo.data(), *eta_hi = f.eta_hi.data();
  const double* weight = b.weight.data() + Block::ghosts;
  for (int j = 0; j < b.ny; ++j) {
    const int begin = b.at(0, j);
#pragma omp simd
    for (int i = 0; i < b.nx; ++i) {
      const int c = begin + i;
      const double rise = (eta_hi[c] - h_hi[c]) - (eta_lo[c] - h_lo[c]);
      axis.source[c] = -(weight[i] * per_spacing) * (0.5 * (h_lo[c] + h_hi[c])) * rise;
    }
  }
}

}  // namespace couloir
