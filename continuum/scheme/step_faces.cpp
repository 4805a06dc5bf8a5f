#include "continuum/scheme/step_faces.hpp"

#include <algorithm>

#include "continuum/scheme/hll.hpp"

namespace couloir {

StepFaces::StepFaces(const Block& b) {
  const auto jumps = [&](int c, int step) { return b.top[c] != b.top[c - step]; };
  const int row = b.row();
  for (int j = 0; j < b.ny; ++j) {
    for (int i = -1; i <= b.nx + 1; ++i) {
      if (jumps(b.at(i, j), 1)) x.push_back(b.at(i, j));
    }
  }
  for (int j = -1; j <= b.ny + 1; ++j) {
    for (int i = 0; i < b.nx; ++i) {
      if (jumps(b.at(i, j), row)) y.push_back(b.at(i, j));
    }
  }
  for (int j = 0; j < b.ny; ++j) {
    for (int i = 0; i < b.nx; ++i) {
      const int c = b.at(i, j);
      if (jumps(c, 1) || jumps(c + 1, 1) || jumps(c, row) || jumps(c + row, row)) cells.push_back(c);
    }
  }
}

void flatten_at_steps(const StepFaces& steps, const Block&, const Fields& q, const Scratch& w, const Axis& axis, FaceValues& f) {
  for (int face : steps.along(axis)) {
    for (int c : {face - axis.step, face}) {
      f.h_lo[c] = f.h_hi[c] = q.h[c];
      f.eta_lo[c] = f.eta_hi[c] = w.eta[c];
      f.un_lo[c] = f.un_hi[c] = axis.un[c];
      f.ut_lo[c] = f.ut_hi[c] = axis.ut[c];
    }
  }
}

void step_face_fluxes(const Parameters& p, const StepFaces& steps, const Block& b, const Scratch& w, const Axis& axis,
                      const FaceValues& f) {
  FaceFluxes& out = *axis.fluxes;
  for (int c : steps.along(axis)) {
    const auto [i, j] = b.local(c);
    if (i < 0 || j < 0 || i >= axis.faces_i || j >= axis.faces_j) continue;
    const int l = c - axis.step, r = c;
    const double g = axis.weight[i + Block::ghosts], gl = axis.k[l] * g, gr = axis.k[r] * g;
    const double floor_l = b.bed[l] + b.top[l], floor_r = b.bed[r] + b.top[r], sill = std::max(floor_l, floor_r);
    const double hl = f.h_hi[l], hr = f.h_lo[r], ul = f.un_hi[l], ur = f.un_lo[r];
    const double over_l = std::clamp(hl - (sill - floor_l), 0.0, hl), over_r = std::clamp(hr - (sill - floor_r), 0.0, hr);
    const NormalFlux n = hll(over_l, ul, gl, over_r, ur, gr);
    out.mass[c] = n.mass * std::max(w.loose[l], w.loose[r]);
    out.tangent[c] = out.mass[c] * (out.mass[c] > 0 ? f.ut_hi[l] : f.ut_lo[r]);
    out.normal[c] = n.momentum;
    out.normal_below[c] = (n.momentum - wall_flux(over_l, ul, gl)) + wall_flux(hl, ul, gl);
    out.normal_above[c] = (n.momentum - wall_flux(over_r, -ur, gr)) + wall_flux(hr, -ur, gr);
    if (axis.h[l] < p.dry_depth && axis.h[r] < p.dry_depth) out.normal[c] = out.normal_below[c] = out.normal_above[c] = 0;
  }
}

void count_step_faces(const StepFaces& steps, const Block& b, const BlockState& s, const Axis& axis, double share, Tally& t) {
  const FaceFluxes& f = *axis.fluxes;
  const int component = axis.along_x ? 0 : 1;
  const auto interior = [&](int c) {
    const auto [i, j] = b.local(c);
    return i >= 0 && i < b.nx && j >= 0 && j < b.ny;
  };
  for (int c : steps.along(axis)) {
    const int l = c - axis.step;
    if (s.open[c] == 0 || s.open[l] == 0) continue;
    // Only the cells of this block: the neighbour block counts the other side.
    double impulse = 0;
    if (interior(l)) impulse += f.normal_below[c] - f.normal[c];
    if (interior(c)) impulse -= f.normal_above[c] - f.normal[c];
    impulse *= share * axis.face_length;
    const int id = b.top[c] > b.top[l] ? b.obstacle[c] : b.obstacle[l];
    t.impulse[id][component] += impulse;
    t.budget.obstacles[component] -= impulse;
    t.budget.gravity[component] += impulse;  // the cells' own sum took it for the bed's
  }
}

}  // namespace couloir
