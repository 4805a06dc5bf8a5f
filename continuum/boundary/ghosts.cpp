#include "continuum/boundary/ghosts.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

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

std::array<int, 4> four(int first, int row) {
  return {first, first + 1, first + row, first + row + 1};
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
  for (const Block& b : mesh.blocks()) rows_.push_back(b.row());
  for (std::size_t k = 0; k < mesh.blocks().size(); ++k) {
    const Block& b = mesh.blocks()[k];
    // Along each side, so that copies make long runs.
    for (int j = -Block::ghosts; j < b.ny + Block::ghosts; ++j) {
      if (j >= 0 && j < b.ny) continue;
      for (int i = -Block::ghosts; i < b.nx + Block::ghosts; ++i) plan_cell(mesh, static_cast<int>(k), i, j);
    }
    for (int i = -Block::ghosts; i < b.nx + Block::ghosts; ++i) {
      if (i >= 0 && i < b.nx) continue;
      for (int j = 0; j < b.ny; ++j) plan_cell(mesh, static_cast<int>(k), i, j);
    }
    std::vector<Neighbour>& n = plans_[k].neighbours;
    std::sort(n.begin(), n.end());
    n.erase(std::unique(n.begin(), n.end()), n.end());
  }
}

void Ghosts::plan_cell(const Mesh& mesh, int block, int i, int j) {
  const Block& b = mesh.blocks()[block];
  const Source sx = source(b.i0 + i, b.grid.nx, sides_[0], sides_[1]);
  const Source sy = source(b.j0 + j, b.grid.ny, sides_[2], sides_[3]);
  const int to = b.at(i, j);
  Plan& plan = plans_[block];
  if (sx.turn != 0 || sy.turn != 0) {
    const Mirror mirror{to, b.at(sx.turn != 0 ? sx.index - b.i0 : i, sy.turn != 0 ? sy.index - b.j0 : j), sx.turn, sy.turn};
    const bool inflow = sx.inflow >= 0 || sy.inflow >= 0;
    inflow ? plan.fixed.push_back({mirror, sx.inflow >= 0 ? sx.inflow : 2 + sy.inflow}) : plan.mirrors.push_back(mirror);
    return;
  }
  const Mesh::Found from = mesh.find(b.level, sx.index, sy.index);
  if (from.block < 0) throw std::logic_error("two blocks that touch differ by more than one level");
  const int along = i < 0 ? wet_downstream : i >= b.nx ? wet_upstream : 0, across = j < 0 ? wet_left : j >= b.ny ? wet_right : 0;
  plan.neighbours.push_back({from.block, static_cast<WetPlaces>(along | across)});
  if (from.level == b.level) copy(block, {to, {from.block, from.cell}});
  if (from.level > b.level) plan.finer.push_back({to, {from.block, from.cell}});
  const bool first = sx.index % 2 == 0 && sy.index % 2 == 0;
  if (from.level < b.level && first) plan.coarser.push_back({to, {from.block, from.cell}, {}, 0, {}});
}

void Ghosts::copy(int block, const Copy& c) {
  std::vector<Run>& runs = plans_[block].copies;
  if (!runs.empty() && runs.back().from.block == c.from.block) {
    Run& r = runs.back();
    if (r.count == 1) r.to_step = c.to - r.to, r.from_step = c.from.cell - r.from.cell;
    if (c.to == r.to + r.count * r.to_step && c.from.cell == r.from.cell + r.count * r.from_step) {
      ++r.count;
      return;
    }
  }
  runs.push_back({c.to, 0, c.from, 0, 1});
}

// The copies of one quantity. What lies in one row is moved as a whole.
void Ghosts::take(const Run& r, const std::vector<double>& from, std::vector<double>& to) {
  const double* f = from.data() + r.from.cell;
  double* t = to.data() + r.to;
  if (r.to_step == 1 && r.from_step == 1) {
    std::copy_n(f, r.count, t);
    return;
  }
  for (int n = 0; n < r.count; ++n) t[n * r.to_step] = f[n * r.from_step];
}

template <class F>
void Ghosts::for_beyond(int block, F&& take) const {
  for (const Mirror& m : plans_[block].mirrors) take(m);
  for (const Fixed& f : plans_[block].fixed) take(f.mirror);
}

// From coarse to fine: the bed beside a finer block slopes as that of the coarser cells and their ghosts.
void Ghosts::extend(Mesh& mesh) {
  for (int level = 0; level <= mesh.levels(); ++level) {
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      Block& b = mesh.blocks()[k];
      if (b.level != level) continue;
      for (const Run& r : plans_[k].copies) {
        const Block& other = mesh.blocks()[r.from.block];
        take(r, other.bed, b.bed);
        take(r, other.top, b.top);
        for (int n = 0; n < r.count; ++n) b.obstacle[r.to + n * r.to_step] = other.obstacle[r.from.cell + n * r.from_step];
      }
      for (const Copy& c : plans_[k].finer) {
        const Block& other = mesh.blocks()[c.from.block];
        b.bed[c.to] = mean_of_children(other.bed.data(), c.from.cell, other.row());
        const auto [i, j] = other.local(c.from.cell);
        std::tie(b.top[c.to], b.obstacle[c.to]) = mesh.step_at(b.grid.x((other.i0 + i) / 2), b.grid.y((other.j0 + j) / 2));
      }
      for (FromCoarser& c : plans_[k].coarser) {
        const Block& other = mesh.blocks()[c.from.block];
        const auto [x, y] = bed_slopes_of(other, c.from.cell);
        c.bed = other.bed[c.from.cell];
        c.children = {c.bed - x - y, c.bed + x - y, c.bed - x + y, c.bed + x + y};
        const auto cells = four(c.to, b.row());
        for (int n = 0; n < 4; ++n) {
          b.bed[cells[n]] = c.children[n];
          b.top[cells[n]] = other.top[c.from.cell];
          b.obstacle[cells[n]] = other.obstacle[c.from.cell];
        }
      }
      for_beyond(static_cast<int>(k), [&](const Mirror& m) {
        b.bed[m.to] = b.bed[m.from];
        b.top[m.to] = b.top[m.from];
        b.obstacle[m.to] = b.obstacle[m.from];
      });
    }
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

void Ghosts::look(const Mesh& mesh, const std::vector<BlockState>& states, int block, double dry_depth,
                  const std::vector<char>& mine) {
  for (FromCoarser& c : plans_[block].coarser) {
    if (!mine.empty() && !mine[c.from.block]) continue;
    const Fields& q = states[c.from.block].now;
    const int n = c.from.cell;
    c.look = {{q.h[n], q.hu[n], q.hv[n]}, {}, slopes_of(q, mesh.blocks()[c.from.block], n, dry_depth)};
  }
}

void Ghosts::look_ahead(const std::vector<BlockState>& states, int block, double dry_depth, const std::vector<char>& mine) {
  for (FromCoarser& c : plans_[block].coarser) {
    if (!mine.empty() && !mine[c.from.block]) continue;
    const BlockState& s = states[c.from.block];
    const int n = c.from.cell;
    c.look.change = {};
    if (s.stepped && s.start.h[n] >= dry_depth)
      c.look.change = {s.now.h[n] - s.start.h[n], s.now.hu[n] - s.start.hu[n], s.now.hv[n] - s.start.hv[n]};
  }
}

void Ghosts::fill(std::vector<BlockState>& states, int block, double share) const {
  const Plan& plan = plans_[block];
  Fields& to = states[block].now;
  for (const Run& r : plan.copies) {
    const Fields& from = states[r.from.block].now;
    take(r, from.h, to.h);
    take(r, from.hu, to.hu);
    take(r, from.hv, to.hv);
  }
  const auto put = [&](int cell, const FlowState& q) { to.h[cell] = q.h, to.hu[cell] = q.hu, to.hv[cell] = q.hv; };
  for (const Copy& c : plan.finer) put(c.to, parent_of(states[c.from.block].now, rows_[c.from.block], c.from.cell));
  for (const FromCoarser& c : plan.coarser) {
    const auto& [now, change, slopes] = c.look;
    const FlowState q{now.h + share * change.h, now.hu + share * change.hu, now.hv + share * change.hv};
    const auto children = children_of(q, c.bed, slopes, c.children);
    const auto cells = four(c.to, rows_[block]);
    for (int k = 0; k < 4; ++k) put(cells[k], children[k]);
  }
  const auto mirrored = [&](const Mirror& m) {
    return FlowState{to.h[m.from], turned(to.hu[m.from], m.u), turned(to.hv[m.from], m.v)};
  };
  for (const Mirror& m : plan.mirrors) put(m.to, mirrored(m));
  for (const Fixed& f : plan.fixed) {
    const FlowState& q = inflow_[f.side];
    put(f.mirror.to, q.h == 0 ? mirrored(f.mirror) : q);
  }
}

template <class F>
void Ghosts::fill_plain(int block, std::vector<double>& to, F&& of) const {
  const Plan& plan = plans_[block];
  for (const Run& r : plan.copies) take(r, of(r.from.block), to);
  for (const Copy& c : plan.finer) to[c.to] = mean_of_children(of(c.from.block).data(), c.from.cell, rows_[c.from.block]);
  for (const FromCoarser& c : plan.coarser) {
    for (int cell : four(c.to, rows_[block])) to[cell] = of(c.from.block)[c.from.cell];
  }
  for_beyond(block, [&](const Mirror& m) { to[m.to] = to[m.from]; });
}

void Ghosts::fill_passive(std::vector<BlockState>& states, int block) const {
  fill_plain(
      block, states[block].passive_x, [&](int b) -> const auto& { return states[b].passive_x; });
  fill_plain(
      block, states[block].passive_y, [&](int b) -> const auto& { return states[b].passive_y; });
}

void Ghosts::fill_open(std::vector<BlockState>& states, int block) const {
  std::vector<double>& to = states[block].open;
  fill_plain(
      block, to, [&](int b) -> const auto& { return states[b].open; });
  states[block].all_open = std::all_of(to.begin(), to.end(), [](double o) { return o == 1; });
}

}  // namespace couloir
