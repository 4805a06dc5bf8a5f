#include "continuum/scheme/stage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "continuum/scheme/effects.hpp"
#include "continuum/scheme/face_flux.hpp"
#include "continuum/scheme/mobilisation.hpp"
#include "continuum/scheme/reconstruct.hpp"
#include "continuum/scheme/rest.hpp"
#include "continuum/scheme/velocity.hpp"

namespace couloir {
namespace {

void fluxes_along(const Axis& axis, const Parameters& p, const Block& b, const BlockFaces& faces, const CoveredZones& zones,
                  AcrossLevels across, const BlockState& s, Scratch& w) {
  find_shocks(p, b, axis, s.now, w.smooth);
  w.laps.lap(StepPart::shocks);
  if (with_relief(b)) flatten_at_feet(b, axis, s.now, w.smooth);
  w.laps.lap(StepPart::bed);
  reconstruct_all(p, b, axis, s.now, w, w.values);
  w.laps.lap(StepPart::reconstruction);
  flatten_at_steps(faces.steps, b, s.now, w, axis, w.values);
  w.laps.lap(StepPart::bed_steps);
  face_fluxes(p, b, axis, w, w.values);
  w.laps.lap(StepPart::fluxes);
  step_face_fluxes(p, faces.steps, b, w, axis, w.values);
  w.laps.lap(StepPart::bed_steps);
  side_fluxes(p, b, axis, w.values);
  w.laps.lap(StepPart::sides);
  if (across.from_finer) take_from_finer(faces.taken, b, axis, w.values, *across.from_finer);
  w.laps.lap(StepPart::levels);
  rim_fluxes(faces.rim, zones, axis);
  w.laps.lap(StepPart::zone_rims);
  if (across.to_coarser) give_to_coarser(faces.given, b, axis, w.values, *across.to_coarser);
  w.laps.lap(StepPart::levels);
  if (with_relief(b)) bed_source(b, axis, w.values);
  w.laps.lap(StepPart::bed);
}

void count_gauges(const BlockFaces& faces, const Block& b, const BlockState& s, const Axis& x, double share, Tally& t) {
  for (const GaugeFaces& g : faces.gauges) {
    for (int j = g.j0; j < g.j1; ++j) {
      const int c = b.at(g.i, j);
      const bool solvers_own = s.open[c] != 0 || s.open[c - 1] != 0;
      if (solvers_own) t.gauge[g.gauge] += share * x.face_length * x.fluxes->mass[c];
    }
  }
}

}  // namespace

void run_stage(const Parameters& p, const Block& b, const BlockFaces& faces, const CoveredZones& zones, AcrossLevels across,
               BlockState& s, Scratch& w, StageName stage, double dt, Tally& t) {
  const EarthPressure& closure = p.closure.earth_pressure;
  const Axis x = Axis::x(b, s, w, closure), y = Axis::y(b, s, w, closure);
  w.laps.start();
  find_velocity(p, b, s.now, w);
  w.laps.lap(StepPart::velocities);
  find_earth_pressure(p, b, s, w);
  w.laps.lap(StepPart::earth_pressure);
  find_locked(p, b, s, w);
  w.laps.lap(StepPart::rest);
  const bool from_finer = across.from_finer && !faces.taken.empty();
  w.one_flux = !with_relief(b) && faces.steps.x.empty() && faces.steps.y.empty() && faces.boxes.empty() && !from_finer &&
               !w.locked && s.all_open;
  for (const Axis& axis : {x, y}) {
    fluxes_along(axis, p, b, faces, zones, across, s, w);
    count_sides(p, b, s, axis, 0.5 * dt, t);
    w.laps.lap(StepPart::sides);
    count_step_faces(faces.steps, b, s, axis, 0.5 * dt, t);
    w.laps.lap(StepPart::bed_steps);
    if (with_relief(b)) count_bed_push(faces.pushed, b, s, axis, 0.5 * dt, t);
    w.laps.lap(StepPart::bed);
    count_box_faces(faces.boxes, b, axis, 0.5 * dt, t);
    w.laps.lap(StepPart::measures);
  }
  count_gauges(faces, b, s, x, 0.5 * dt, t);
  count_box_weight(faces.boxes, b, s, 0.5 * dt, t);
  w.laps.lap(StepPart::measures);
  update(p, b, s, w, stage, dt, with_relief(b), !faces.boxes.empty(), t);
  w.laps.lap(StepPart::update);
  count_box_friction(faces.boxes, b, w, t);
  w.laps.lap(StepPart::measures);
}

double begin_step(const Parameters& p, const Block& b, const BlockFaces& faces, BlockState& s, Scratch& w, double since) {
  w.laps.start();
  find_velocity(p, b, s.now, w);
  w.laps.lap(StepPart::velocities);
  mobilise(p, b, faces.steps, s, w, since);
  find_earth_pressure(p, b, s, w);
  w.laps.lap(StepPart::earth_pressure);
  const double stiffness_x = p.closure.earth_pressure.stiffness_x(), stiffness_y = p.closure.earth_pressure.stiffness_y();
  const auto comes_in = [&](int side) { return p.sides[side].kind == Side::Kind::inflow ? 1 : 0; };
  const int i0 = b.i0 == 0 ? -comes_in(0) : 0, i1 = b.nx + (b.i0 + b.nx == b.grid.nx ? comes_in(1) : 0);
  const int j0 = b.j0 == 0 ? -comes_in(2) : 0, j1 = b.ny + (b.j0 + b.ny == b.grid.ny ? comes_in(3) : 0);
  const auto fastest = [&]<bool earth_pressure>(std::bool_constant<earth_pressure>) {
    double rate = 0, not_finite = 0;
    const double *h = s.now.h.data(), *hu = s.now.hu.data(), *hv = s.now.hv.data(), *u = w.u.data(), *v = w.v.data(),
                 *kx = w.kx.data(), *ky = w.ky.data();
    const double* weight = b.weight.data() + Block::ghosts;
    const double per_dx = 1 / b.grid.dx, per_dy = 1 / b.grid.dy;
    for (int j = j0; j < j1; ++j) {
      const int row = b.at(0, j);
#pragma omp simd reduction(max : rate) reduction(+ : not_finite)
      for (int i = i0; i < i1; ++i) {
        const int c = row + i;
        const double gh = weight[i] * std::max(0.0, h[c]);
        const double x = earth_pressure ? k_of_step(kx[c], stiffness_x) * gh : gh;
        const double y = earth_pressure ? k_of_step(ky[c], stiffness_y) * gh : gh;
        const double here = (std::abs(u[c]) + std::sqrt(x)) * per_dx + (std::abs(v[c]) + std::sqrt(y)) * per_dy;
        rate = std::max(rate, here);
        const double all = here + h[c] + hu[c] + hv[c];
        not_finite += all - all == 0 ? 0.0 : 1.0;
      }
    }
    return not_finite == 0 ? rate : std::numeric_limits<double>::infinity();
  };
  const double rate = with_earth_pressure(p) ? fastest(std::bool_constant<built::earth_pressure>()) : fastest(std::false_type());
  w.laps.lap(StepPart::rates);
  return rate;
}

}  // namespace couloir
