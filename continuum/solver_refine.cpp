// Another mesh: where it is to be finer, and what its cells then hold.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "continuum/scheme/effects.hpp"
#include "continuum/solver_impl.hpp"

namespace couloir {
namespace {

constexpr int children[][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};

bool periodic(const SolverSettings& s, int axis) {
  return s.sides[2 * axis].kind == Side::Kind::periodic;
}

// How far a place is from a stretch, round a period that is not 0.
double gap(double at, double from, double to, double period) {
  const auto beyond = [&](double by) { return std::max(from + by - at, at - to - by); };
  return period > 0 ? std::min({beyond(0), beyond(period), beyond(-period)}) : beyond(0);
}

}  // namespace

void Solver::Impl::refine_boxes() {
  if (settings.refinement.empty()) return;
  std::vector<Wish> wishes = wishes_of(settings.refinement.boxes);
  wrap(wishes, settings.grid, periodic(settings, 0), periodic(settings, 1));
  grow_fully(*forest, wishes, settings.grid, settings.block);
  mesh.become(forest->leaves());
}

void Solver::Impl::take_leaves(const std::vector<Leaf>& leaves) {
  if (leaves == mesh.leaves()) return;
  if (!forest)
    throw std::invalid_argument("The checkpoint has refined blocks and this continuum has none; restore it with its own scene.");
  forest->become(leaves);
  mesh.become(forest->leaves());
  if (mesh.leaves() != leaves)
    throw std::invalid_argument("The checkpoint's blocks are no mesh of this continuum; restore it with its own scene.");
  start_empty();
}

bool Solver::Impl::adapt() {
  if (settings.refinement.adaptive.levels == 0) return false;
  refresh();
  sync();
  fill_all_ghosts();
  std::vector<Wish> all = wishes_of(settings.refinement.boxes);
  wish_by_state(all);
  wrap(all, settings.grid, periodic(settings, 0), periodic(settings, 1));
  // One level a time, so that no block's new cells are more than one level away from its old ones.
  if (!grow(*forest, all, settings.grid, settings.block)) return false;
  become(forest->leaves());
  return true;
}

// Cells that ask for finer ones, with those around that the flow may reach before the next look: it crosses less than half a cell
// of the coarsest size in a step.
void Solver::Impl::wish_by_state(std::vector<Wish>& all) const {
  const Adaptive& a = settings.refinement.adaptive;
  const Grid& g = settings.grid;
  double deepest = 0;
  for_cells([&](int k, int c) { deepest = std::max(deepest, states[k].now.h[c]); });
  if (!(deepest > 0)) return;
  const double film = std::max(0.01 * deepest, settings.dry_depth), reach = 0.5 * a.interval + 1;
  const double around_x = periodic(settings, 0) ? g.nx * g.dx : 0, around_y = periodic(settings, 1) ? g.ny * g.dy : 0;
  std::vector<bool> near(obstacle_boxes.size(), false);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Block& b = mesh.blocks()[k];
    const BlockState& s = states[k];
    if (!s.wet) continue;
    CellBox ask{b.nx, 0, b.ny, 0}, keep = ask;
    const auto include = [](CellBox& box, int i, int j) {
      box = {std::min(box.i0, i), std::max(box.i1, i + 1), std::min(box.j0, j), std::max(box.j1, j + 1)};
    };
    for (int j = 0; j < b.ny; ++j) {
      for (int i = 0; i < b.nx; ++i) {
        const int c = b.at(i, j);
        if (s.open[c] == 0 || s.now.h[c] < 0.5 * film) continue;
        double drop = 0, least_ahead = s.now.h[c];
        const double outward[] = {-s.now.hu[c], s.now.hu[c], -s.now.hv[c], s.now.hv[c]};
        const int beside[] = {c - 1, c + 1, c - b.row(), c + b.row()};
        for (int d = 0; d < 4; ++d) {
          const int n = beside[d];
          drop = std::max(drop,
                          std::min(std::abs(s.now.h[n] + b.bed[n] - s.now.h[c] - b.bed[c]), std::abs(s.now.h[n] - s.now.h[c])));
          if (outward[d] >= 0) least_ahead = std::min(least_ahead, s.now.h[n]);
        }
        const auto holds = [&](double share) {
          return (a.front && s.now.h[c] >= share * film && least_ahead < film / share) ||
                 (a.gradient > 0 && drop >= share * a.gradient * deepest);
        };
        if (holds(1)) include(ask, i, j);
        if (holds(0.5)) include(keep, i, j);
        const double x = b.grid.x(b.i0 + i), y = b.grid.y(b.j0 + j);
        for (std::size_t o = 0; o < near.size(); ++o) {
          const auto& [x0, x1, y0, y1] = obstacle_boxes[o];
          const double far = std::max(gap(x, x0, x1, around_x), gap(y, y0, y1, around_y));
          near[o] = near[o] || (a.obstacle > 0 && far <= a.obstacle + reach * std::max(g.dx, g.dy));
        }
      }
    }
    const auto wish = [&](const CellBox& box, int level) {
      if (box.empty()) return;
      const double x0 = b.grid.x0 + (b.i0 + box.i0) * b.grid.dx, y0 = b.grid.y0 + (b.j0 + box.j0) * b.grid.dy;
      all.push_back({x0 - reach * g.dx, x0 + (box.i1 - box.i0) * b.grid.dx + reach * g.dx, y0 - reach * g.dy,
                     y0 + (box.j1 - box.j0) * b.grid.dy + reach * g.dy, level});
    };
    wish(ask, a.levels);
    wish(keep, b.level);
  }
  for (std::size_t o = 0; o < near.size(); ++o) {
    const auto& [x0, x1, y0, y1] = obstacle_boxes[o];
    if (near[o]) all.push_back({x0 - a.obstacle, x1 + a.obstacle, y0 - a.obstacle, y1 + a.obstacle, a.levels});
  }
  for (int id = 0; a.zone && id < zones.ids(); ++id) {
    const CellBox& z = zones.zone(id).box();
    if (z.empty()) continue;
    const double x0 = g.x0 + z.i0 * g.dx, x1 = g.x0 + z.i1 * g.dx, y0 = g.y0 + z.j0 * g.dy, y1 = g.y0 + z.j1 * g.dy;
    for (double x : {x0, x1}) all.push_back({x - g.dx, x + g.dx, y0 - g.dy, y1 + g.dy, a.levels});
    for (double y : {y0, y1}) all.push_back({x0 - g.dx, x1 + g.dx, y - g.dy, y + g.dy, a.levels});
  }
}

// With what every rank holds itself.
void Solver::Impl::fill_all_ghosts() {
  for (std::size_t level = 0; level < levels.size(); ++level) {
    for (int k : levels[level].blocks) {
      ghosts->look(mesh, states, k, settings.dry_depth);
      fill_block(k, 0, true);
    }
  }
}

void Solver::Impl::become(const std::vector<Leaf>& leaves) {
  const std::array<double, 2> momentum_before = momentum();
  std::vector<std::array<double, 2>> in_boxes;
  for (const ControlBox& b : boxes) in_boxes.push_back(momentum_in(b.cells));
  Mesh old = mesh;
  std::vector<BlockState> held = std::move(states);
  mesh.become(leaves);
  lay_blocks();
  states = std::vector<BlockState>(mesh.blocks().size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    const int same = old.block_of(mesh.leaves()[k]);
    if (same >= 0) {
      states[k] = std::move(held[same]);
    } else {
      size(states[k], mesh.blocks()[k]);
      const Leaf& l = mesh.leaves()[k];
      const int parent = old.block_of({l.level - 1, l.bi >> 1, l.bj >> 1});
      parent >= 0 ? take_from_parent(static_cast<int>(k), old.blocks()[parent], held[parent])
                  : take_from_children(static_cast<int>(k), old, held);
    }
    states[k].looked = false;
  }
  deal();
  mark_open();
  lay_rims();
  for (std::size_t g = 0; g < gauges.size(); ++g) lay_gauge(static_cast<int>(g));
  for (std::size_t b = 0; b < boxes.size(); ++b) lay_box(static_cast<int>(b));
  rate.reset();

  // Only films that were no films before have lost theirs.
  const std::array<double, 2> momentum_after = momentum();
  for (int q : {0, 1}) budget.cutoff[q] += momentum_after[q] - momentum_before[q];
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const auto now = momentum_in(boxes[b].cells);
    for (int q : {0, 1}) boxes[b].terms.friction[q] += now[q] - in_boxes[b][q];
  }
}

void Solver::Impl::take_from_parent(int block, const Block& parent, const BlockState& held) {
  const Block& b = mesh.blocks()[block];
  BlockState& s = states[block];
  for (int j = 0; j < b.ny; j += 2) {
    for (int i = 0; i < b.nx; i += 2) {
      const int from = parent.at((b.i0 + i) / 2 - parent.i0, (b.j0 + j) / 2 - parent.j0);
      const FlowState q{held.now.h[from], held.now.hu[from], held.now.hv[from]};
      std::array<double, 4> bed;
      for (int n = 0; n < 4; ++n) bed[n] = b.bed[b.at(i + children[n][0], j + children[n][1])];
      const auto all = children_of(q, parent.bed[from], slopes_of(held.now, parent, from, settings.dry_depth), bed);
      for (int n = 0; n < 4; ++n) {
        const int to = b.at(i + children[n][0], j + children[n][1]);
        put_in(block, to, all[n]);
        if (!with_earth_pressure(parameters)) continue;
        s.passive_x[to] = held.passive_x[from];
        s.passive_y[to] = held.passive_y[from];
      }
    }
  }
}

void Solver::Impl::take_from_children(int block, const Mesh& old, const std::vector<BlockState>& held) {
  const Block& b = mesh.blocks()[block];
  BlockState& s = states[block];
  for (int j = 0; j < b.ny; ++j) {
    for (int i = 0; i < b.nx; ++i) {
      const Mesh::Found from = old.find(b.level + 1, 2 * (b.i0 + i), 2 * (b.j0 + j));
      const int to = b.at(i, j), row = old.blocks()[from.block].row();
      const BlockState& child = held[from.block];
      put_in(block, to, parent_of(child.now, row, from.cell));
      if (!with_earth_pressure(parameters)) continue;
      s.passive_x[to] = mean_of_children(child.passive_x.data(), from.cell, row);
      s.passive_y[to] = mean_of_children(child.passive_y.data(), from.cell, row);
    }
  }
}

}  // namespace couloir
