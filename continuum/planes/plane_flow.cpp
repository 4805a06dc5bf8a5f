#include "continuum/planes/plane_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "continuum/errors.hpp"
#include "continuum/scheme/mobilisation.hpp"

namespace couloir {
namespace {

Parameters parameters_of(const PlaneSettings& s) {
  Parameters p{s.closure, s.limiter, {}, s.dry_depth, {}};
  if (s.foot) p.sides[0].kind = Side::Kind::wall;
  return p;
}

}  // namespace

PlaneFlow::PlaneFlow(const PlaneSettings& s) : settings_(s), parameters_(parameters_of(s)) {
  Block& b = block_;
  b.grid = s.grid;
  b.nx = s.grid.nx, b.ny = s.grid.ny;
  b.bed.assign(b.size(), 0.0);
  b.top.assign(b.size(), 0.0);
  b.obstacle.assign(b.size(), -1);
  for (auto* column : {&b.weight, &b.weight_face}) column->assign(b.row(), s.weight);
  b.drive.assign(b.row(), s.drive_a);
  b.tan_zeta.assign(b.row(), s.weight > 0 ? s.drive_a / s.weight : 0.0);
  for (auto* column : {&b.kappa, &b.foot_depth, &b.no_depth}) column->assign(b.row(), 0.0);
  state_.now.resize(b.size());
  state_.start.resize(b.size());
  state_.passive_x.assign(b.size(), 0.0);
  state_.passive_y.assign(b.size(), 0.0);
  state_.open.assign(b.size(), 1.0);
  scratch_.resize(b.size());
  for (SideName side : all_sides) imposed_[static_cast<int>(side)].resize(faces(side));
}

FlowState PlaneFlow::at(int i, int j) const {
  const int c = block_.at(i, j);
  return {state_.now.h[c], state_.now.hu[c], state_.now.hv[c]};
}

void PlaneFlow::set(int i, int j, const FlowState& q) {
  const int c = block_.at(i, j);
  const bool wet = q.h >= settings_.dry_depth;
  state_.now.h[c] = q.h, state_.now.hu[c] = wet ? q.hu : 0.0, state_.now.hv[c] = wet ? q.hv : 0.0;
  state_.passive_x[c] = state_.passive_y[c] = 0;
  if (wet) state_.wet |= block_.places_of(c);
}

double PlaneFlow::volume() const {
  double sum = 0;
  for (int j = 0; j < block_.ny; ++j) {
    for (int i = 0; i < block_.nx; ++i) sum += state_.now.h[block_.at(i, j)];
  }
  return sum * grid().dx * grid().dy;
}

std::array<double, 2> PlaneFlow::momentum() const {
  double a = 0, b = 0;
  for (int j = 0; j < block_.ny; ++j) {
    for (int i = 0; i < block_.nx; ++i) a += state_.now.hu[block_.at(i, j)], b += state_.now.hv[block_.at(i, j)];
  }
  return {a * grid().dx * grid().dy, b * grid().dx * grid().dy};
}

double PlaneFlow::max_speed() const {
  double fastest = 0;
  for (int j = 0; j < block_.ny; ++j) {
    for (int i = 0; i < block_.nx; ++i) {
      const FlowState q = at(i, j);
      if (q.h >= settings_.dry_depth) fastest = std::max(fastest, std::hypot(q.hu, q.hv) / q.h);
    }
  }
  return fastest;
}

// Beyond an edge the flow is taken to go on as it is: no slopes across an edge.
void PlaneFlow::fill_ghosts() {
  const Block& b = block_;
  for (int j = -Block::ghosts; j < b.ny + Block::ghosts; ++j) {
    for (int i = -Block::ghosts; i < b.nx + Block::ghosts; ++i) {
      const int to = b.at(i, j), from = b.at(std::clamp(i, 0, b.nx - 1), std::clamp(j, 0, b.ny - 1));
      for (auto* q : {&state_.now.h, &state_.now.hu, &state_.now.hv, &state_.passive_x, &state_.passive_y}) (*q)[to] = (*q)[from];
    }
  }
}

void PlaneFlow::find_closures() {
  fill_ghosts();
  kernels_->find_velocity(parameters_, block_, state_.now, scratch_);
  kernels_->find_earth_pressure(parameters_, block_, state_, scratch_);
}

void PlaneFlow::refresh() {
  if (!state_.wet) return;
  fill_ghosts();
  kernels_->find_velocity(parameters_, block_, state_.now, scratch_);
  kernels_->mobilise(parameters_, block_, no_steps_, state_, scratch_, strained_);
  strained_ = 0;
  fill_ghosts();
  kernels_->find_earth_pressure(parameters_, block_, state_, scratch_);
}

double PlaneFlow::stable_dt() const {
  const double none = std::numeric_limits<double>::infinity();
  if (!state_.wet) return none;
  const Grid& g = grid();
  const EarthPressure& closure = parameters_.closure.earth_pressure;
  double rate = 0;
  for (int j = 0; j < block_.ny; ++j) {
    for (int i = 0; i < block_.nx; ++i) {
      const int c = block_.at(i, j);
      const double gh = settings_.weight * std::max(0.0, state_.now.h[c]);
      rate =
          std::max(rate, (std::abs(scratch_.u[c]) + std::sqrt(k_of_step(scratch_.kx[c], closure.stiffness_x()) * gh)) / g.dx +
                             (std::abs(scratch_.v[c]) + std::sqrt(k_of_step(scratch_.ky[c], closure.stiffness_y()) * gh)) / g.dy);
    }
  }
  // As the slope's solver: gravity may speed up what is slow now.
  const double a = std::abs(settings_.drive_a) / g.dx + std::abs(settings_.drive_b) / g.dy;
  const double most = rate + std::sqrt(rate * rate + 4 * a * settings_.cfl);
  return most > 0 ? 2 * settings_.cfl / most : none;
}

int PlaneFlow::edge_index(SideName side, int k) const {
  const int last_a = block_.nx - 1, last_b = block_.ny - 1;
  switch (side) {
    case SideName::upstream:
      return block_.at(0, k);
    case SideName::downstream:
      return block_.at(last_a, k);
    case SideName::left:
      return block_.at(k, 0);
    case SideName::right:
      break;
  }
  return block_.at(k, last_b);
}

EdgeCell PlaneFlow::edge_cell(SideName side, int k) const {
  const int c = edge_index(side, k);
  if (!state_.wet || state_.now.h[c] < settings_.dry_depth) return {};
  const bool a = is_a(side);
  const double normal = a ? scratch_.u[c] : scratch_.v[c], along = a ? scratch_.v[c] : scratch_.u[c];
  return {state_.now.h[c], is_low(side) ? -normal : normal, along, (a ? scratch_.kx[c] : scratch_.ky[c]) * settings_.weight};
}

double PlaneFlow::content(SideName side, int k) const {
  return state_.now.h[edge_index(side, k)] * (is_a(side) ? grid().dx : grid().dy);
}

void PlaneFlow::impose(SideName side, int k, const FaceFlux& f) {
  imposed_[static_cast<int>(side)].at(k) = f;
}

bool PlaneFlow::at_work() const {
  if (state_.wet) return true;
  return std::ranges::any_of(
      imposed_, [](const auto& faces) { return std::ranges::any_of(faces, [](const FaceFlux& f) { return f.mass != 0; }); });
}

void PlaneFlow::step(double dt) {
  if (!at_work()) return;
  strained_ = dt;
  Tally t;
  for (StageName name : {StageName::predictor, StageName::corrector}) {
    t.reset(0, 0, 0);
    stage(name, dt, t);
    if (!t.finite || t.min_depth < 0) {
      throw NumericsError("The flow on the " + settings_.name + " of an obstacle made of planes is " +
                          (t.finite ? "overdrawn" : "not finite") + "; lower continuum.cfl, or use method: step.");
    }
    budget_.add(t.budget);
    min_depth_ = std::min(min_depth_, t.min_depth);
  }
  updates_ += 2L * block_.nx * block_.ny;
}

// What crosses the edges is given; the cells on them pass on to their neighbours no more than that leaves them, in both stages.
void PlaneFlow::limit_outflow(StageName name, double dt) {
  const Block& b = block_;
  FaceFluxes &x = scratch_.x, &y = scratch_.y;
  const int row = b.row();
  Values& share = scratch_.source_x;  // free at this point
  std::fill(share.begin(), share.end(), 1.0);
  const double reserve = name == StageName::predictor ? 2 : 1;
  bool some = false;
  const auto split = [&](double outward, bool edge, double& inside, double& across) {
    (edge ? across : inside) += edge ? outward : std::max(outward, 0.0);
  };
  for (int j = 0; j < b.ny; ++j) {
    for (int i = 0; i < b.nx; ++i) {
      const int c = b.at(i, j);
      double x_inside = 0, x_across = 0, y_inside = 0, y_across = 0;
      split(-x.mass[c], i == 0, x_inside, x_across);
      split(x.mass[c + 1], i == b.nx - 1, x_inside, x_across);
      split(-y.mass[c], j == 0, y_inside, y_across);
      split(y.mass[c + row], j == b.ny - 1, y_inside, y_across);
      const double asked = dt * (x_inside / grid().dx + y_inside / grid().dy);
      const double edges = dt * (std::max(x_across, 0.0) / grid().dx + std::max(y_across, 0.0) / grid().dy);
      const double has = std::max(0.0, state_.now.h[c] - reserve * edges) * (1 - 1e-9);
      if (asked > has) share[c] = has / asked, some = true;
    }
  }
  if (!some) return;
  const auto scale = [&](FaceFluxes& f, int face, int below) {
    const double s = share[f.mass[face] > 0 ? below : face];
    for (auto* q : {&f.mass, &f.tangent, &f.normal, &f.normal_below, &f.normal_above}) (*q)[face] *= s;
  };
  for (int j = 0; j < b.ny; ++j) {
    for (int i = 1; i < b.nx; ++i) scale(x, b.at(i, j), b.at(i - 1, j));
  }
  for (int j = 1; j < b.ny; ++j) {
    for (int i = 0; i < b.nx; ++i) scale(y, b.at(i, j), b.at(i, j - 1));
  }
}

// What comes over an edge pushes the cell that it meets.
void PlaneFlow::loosen_where_it_comes_in() {
  for (SideName side : all_sides) {
    for (int k = 0; k < faces(side); ++k) {
      if (imposed_[static_cast<int>(side)][k].mass != 0) scratch_.loose[edge_index(side, k)] = 1;
    }
  }
}

void PlaneFlow::stage(StageName name, double dt, Tally& t) {
  Scratch& w = scratch_;
  const Block& b = block_;
  find_closures();
  if (settings_.weight > 0 && settings_.drive_b == 0) {
    kernels_->find_locked(parameters_, b, state_, w);
    loosen_where_it_comes_in();
  } else {
    std::fill(w.loose.begin(), w.loose.end(), 1.0);
  }
  const EarthPressure& closure = parameters_.closure.earth_pressure;
  const Axis x = Axis::x(b, state_, w, closure), y = Axis::y(b, state_, w, closure);
  for (const Axis& axis : {x, y}) {
    kernels_->find_shocks(parameters_, b, axis, state_.now, w.smooth);
    kernels_->reconstruct_all(parameters_, b, axis, state_.now, w, w.values);
    kernels_->face_fluxes(parameters_, b, axis, w, w.values);
    FaceFluxes& f = *axis.fluxes;
    for (SideName side : all_sides) {
      if (is_a(side) != axis.along_x) continue;
      for (int k = 0; k < faces(side); ++k) {
        const FaceFlux& q = imposed_[static_cast<int>(side)][k];
        const int face = edge_index(side, k) + (is_low(side) ? 0 : axis.step);
        f.mass[face] = q.mass;
        f.normal[face] = f.normal_below[face] = f.normal_above[face] = axis.along_x ? q.mom_x : q.mom_y;
        f.tangent[face] = axis.along_x ? q.mom_y : q.mom_x;
      }
    }
  }
  limit_outflow(name, dt);
  std::fill(w.source_x.begin(), w.source_x.end(), 0.0);
  for (int c = 0; c < b.size(); ++c) w.source_y[c] = state_.now.h[c] * settings_.drive_b;
  kernels_->update(parameters_, b, state_, w, name, dt, true, false, t);
}

Budget PlaneFlow::take_budget() {
  const Budget taken = budget_;
  budget_ = {};
  return taken;
}

void PlaneFlow::save(ByteWriter& put) const {
  for (int j = 0; j < block_.ny; ++j) {
    for (int i = 0; i < block_.nx; ++i) {
      const int c = block_.at(i, j);
      put(at(i, j)), put(state_.passive_x[c]), put(state_.passive_y[c]);
    }
  }
  put(strained_), put(min_depth_), put(updates_), put(budget_);
}

void PlaneFlow::restore(ByteReader& in) {
  state_.wet = 0;
  for (int j = 0; j < block_.ny; ++j) {
    for (int i = 0; i < block_.nx; ++i) {
      const int c = block_.at(i, j);
      set(i, j, in.take<FlowState>());
      state_.passive_x[c] = in.take<double>(), state_.passive_y[c] = in.take<double>();
    }
  }
  strained_ = in.take<double>();
  min_depth_ = in.take<double>(), updates_ = in.take<long>(), budget_ = in.take<Budget>();
}

}  // namespace couloir
