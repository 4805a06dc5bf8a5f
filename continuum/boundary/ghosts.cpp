#include "continuum/boundary/ghosts.hpp"

#include <algorithm>
#include <stdexcept>

namespace couloir {
namespace {

// Where along one direction a ghost index takes its state from.
struct Source {
  int index;
  signed char turn = 0;  // as Mirror::u
  int inflow = -1;       // the side, 0 low or 1 high, that gives the state
};

Source source(int i, int n, const Side& low, const Side& high) {
  if (i >= 0 && i < n) return {i};
  const bool below = i < 0;
  const Side& side = below ? low : high;
  const int mirrored = std::clamp(below ? -1 - i : 2 * n - 1 - i, 0, n - 1);
  const int last = below ? 0 : n - 1;
  switch (side.kind) {
    case Side::Kind::wall:
      return {mirrored, 2};
    case Side::Kind::periodic:
      return {(i % n + n) % n};
    case Side::Kind::inflow:
      return {mirrored, 2, below ? 0 : 1};
    case Side::Kind::outflow:
      break;
  }
  return {last, static_cast<signed char>(below ? -1 : 1)};
}

double turned(double momentum, signed char turn) {
  if (turn == 0) return momentum;
  return turn == 2 || momentum * turn < 0 ? -momentum : momentum;
}

void check(const std::array<Side, 4>& sides) {
  for (int low : {0, 2}) {
    if ((sides[low].kind == Side::Kind::periodic) != (sides[low + 1].kind == Side::Kind::periodic)) {
      throw std::invalid_argument(
          low == 0 ? "Only one of the sides upstream and downstream is periodic; make both periodic or neither."
                   : "Only one of the sides left and right is periodic; make both periodic or neither.");
    }
  }
  for (const Side& side : sides) {
    if (side.kind != Side::Kind::inflow) continue;
    bool good = side.depth >= 0 && side.velocity >= 0;
    for (std::size_t k = 0; k < side.hydrograph.size(); ++k) {
      const InflowPoint& p = side.hydrograph[k];
      good = good && p.depth >= 0 && p.velocity >= 0;
      if (k > 0 && !(p.time > side.hydrograph[k - 1].time))
        throw std::invalid_argument("The times of an inflow's hydrograph must rise; correct the boundary.");
    }
    if (!good) {
      throw std::invalid_argument(
          "An inflow side needs a depth and an inward velocity that are not negative; correct the boundary.");
    }
  }
}

}  // namespace

Ghosts::Ghosts(const Mesh& mesh, const std::array<Side, 4>& sides) : sides_(sides), plans_(mesh.blocks().size()) {
  check(sides);
  set_time(0);
  for (std::size_t k = 0; k < mesh.blocks().size(); ++k) {
    const Block& b = mesh.blocks()[k];
    for (int j = -Block::ghosts; j < b.ny + Block::ghosts; ++j) {
      for (int i = -Block::ghosts; i < b.nx + Block::ghosts; ++i) {
        const bool interior = i >= 0 && i < b.nx && j >= 0 && j < b.ny;
        if (!interior) plan_cell(mesh, sides, static_cast<int>(k), i, j);
      }
    }
  }
}

void Ghosts::plan_cell(const Mesh& mesh, const std::array<Side, 4>& sides, int block, int i, int j) {
  const Block& b = mesh.blocks()[block];
  const Source sx = source(b.i0 + i, mesh.grid().nx, sides[0], sides[1]);
  const Source sy = source(b.j0 + j, mesh.grid().ny, sides[2], sides[3]);
  const Copy copy{b.at(i, j), mesh.place(sx.index, sy.index)};
  Plan& plan = plans_[block];
  if (sx.inflow >= 0 || sy.inflow >= 0) {
    plan.fixed.push_back({copy, sx.inflow >= 0 ? sx.inflow : 2 + sy.inflow, sx.turn, sy.turn});
  } else if (sx.turn != 0 || sy.turn != 0) {
    plan.mirrors.push_back({copy, sx.turn, sy.turn});
  } else {
    plan.copies.push_back(copy);
  }
}

template <class F>
void Ghosts::for_all(int block, F&& take) const {
  for (const Copy& c : plans_[block].copies) take(c);
  for (const Mirror& m : plans_[block].mirrors) take(m.copy);
  for (const Fixed& f : plans_[block].fixed) take(f.copy);
}

void Ghosts::extend(Mesh& mesh) const {
  for (std::size_t k = 0; k < plans_.size(); ++k) {
    Block& b = mesh.blocks()[k];
    const auto take = [&](const Copy& c) {
      const Block& other = mesh.blocks()[c.from.block];
      b.bed[c.to] = other.bed[c.from.cell];
      b.top[c.to] = other.top[c.from.cell];
      b.obstacle[c.to] = other.obstacle[c.from.cell];
    };
    for_all(static_cast<int>(k), take);
  }
  // All blocks or none: two that share a face must reconstruct its depths alike.
  const bool relief = std::any_of(mesh.blocks().begin(), mesh.blocks().end(), [](const Block& b) {
    return std::any_of(b.bed.begin(), b.bed.end(), [](double z) { return z != 0; });
  });
  for (Block& b : mesh.blocks()) b.relief = relief;
}

void Ghosts::set_time(double time, Moment moment) {
  for (int side = 0; side < 4; ++side) {
    const InflowPoint p = inflow_at(sides_[side], time, moment);
    const double inward = (side % 2 == 0 ? 1 : -1) * p.depth * p.velocity;
    inflow_[side] = {p.depth, side < 2 ? inward : 0.0, side < 2 ? 0.0 : inward};
  }
}

void Ghosts::fill(std::vector<BlockState>& states, int block) const {
  Fields& to = states[block].now;
  for (const Copy& c : plans_[block].copies) {
    const Fields& from = states[c.from.block].now;
    to.h[c.to] = from.h[c.from.cell];
    to.hu[c.to] = from.hu[c.from.cell];
    to.hv[c.to] = from.hv[c.from.cell];
  }
  for (const Mirror& m : plans_[block].mirrors) {
    const Fields& from = states[m.copy.from.block].now;
    to.h[m.copy.to] = from.h[m.copy.from.cell];
    to.hu[m.copy.to] = turned(from.hu[m.copy.from.cell], m.u);
    to.hv[m.copy.to] = turned(from.hv[m.copy.from.cell], m.v);
  }
  for (const Fixed& f : plans_[block].fixed) {
    FlowState q = inflow_[f.side];
    if (q.h == 0) {
      const Fields& from = states[f.copy.from.block].now;
      const int cell = f.copy.from.cell;
      q = {from.h[cell], turned(from.hu[cell], f.u), turned(from.hv[cell], f.v)};
    }
    to.h[f.copy.to] = q.h, to.hu[f.copy.to] = q.hu, to.hv[f.copy.to] = q.hv;
  }
}

void Ghosts::fill_passive(std::vector<BlockState>& states, int block) const {
  BlockState& to = states[block];
  const auto take = [&](const Copy& c) {
    const BlockState& from = states[c.from.block];
    to.passive_x[c.to] = from.passive_x[c.from.cell];
    to.passive_y[c.to] = from.passive_y[c.from.cell];
  };
  for_all(block, take);
}

void Ghosts::fill_open(std::vector<BlockState>& states, int block) const {
  std::vector<double>& to = states[block].open;
  const auto take = [&](const Copy& c) { to[c.to] = states[c.from.block].open[c.from.cell]; };
  for_all(block, take);
  states[block].all_open = std::all_of(to.begin(), to.end(), [](double o) { return o == 1; });
}

}  // namespace couloir
