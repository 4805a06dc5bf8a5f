#include "continuum/solver_impl.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "continuum/mesh/most_levels.hpp"
#include "continuum/scheme/effects.hpp"

namespace couloir {
namespace {

void check(const SolverSettings& s, const ReferenceSurface& surface) {
  const auto require = [](bool good, const std::string& sentence) {
    if (!good) throw std::invalid_argument(sentence);
  };
  require(s.gravity > 0, "The gravity must be positive; correct the scene.");
  require(s.cfl > 0 && s.cfl <= 0.5,
          "The CFL number must be above 0 and at most 0.5, where the depth stays positive; lower continuum.cfl.");
  require(s.limiter != Limiter::eno, "The central-upwind scheme has no ENO slopes; use another limiter, or the scheme noc.");
  require(s.dry_depth > 0, "The dry depth must be positive; correct the settings.");
  require(s.threads >= 1, "The continuum needs at least one thread; correct the number of threads.");
  require(s.closure.tan_delta >= 0, "The basal friction must not be negative; correct the material.");
  require(!(surface.curved() && s.sides[0].kind == Side::Kind::periodic),
          "A surface with an arc cannot be periodic along the slope; choose other sides upstream and downstream.");
  const Refinement& r = s.refinement;
  require(r.levels() >= 0 && r.levels() <= most_levels,
          "Cells can be halved up to " + std::to_string(most_levels) + " times; lower the levels of the refinement.");
  require(r.adaptive.levels == 0 || r.adaptive.interval > 0,
          "The mesh follows the flow at an interval of at least one step; correct it.");
  for (const RefineBox& b : r.boxes) {
    require(b.x1 > b.x0 && b.y1 > b.y0, "A refined box must not be empty; correct its edges.");
    require(b.levels > 0, "A refined box needs at least one level; correct it.");
  }
}

Parameters parameters_of(const SolverSettings& s) {
  return {s.closure, s.limiter, s.sides, s.dry_depth, {}};
}

}  // namespace

Solver::Impl::Impl(const SolverSettings& s, const ReferenceSurface& surface, const StepBed& bed)
    : settings((check(s, surface), s)),
      parameters(parameters_of(s)),
      mesh(s.grid, s.block, surface, bed, s.gravity, s.closure.curvature, s.refinement.levels()),
      scratch(s.threads),
      zones(s.grid, s.sides),
      impulse(bed.obstacles.size()) {
  for (const StepObstacle& o : bed.obstacles) obstacle_boxes.push_back({o.x0, o.x1, o.y0, o.y1});
  if (!s.refinement.empty() || !s.ranks.alone()) {
    const bool around_x = s.sides[0].kind == Side::Kind::periodic, around_y = s.sides[2].kind == Side::Kind::periodic;
    forest = std::make_unique<Forest>(mesh.blocks_x(), mesh.blocks_y(), around_x, around_y, s.refinement.levels(), s.ranks);
    refine_boxes();
  }
  start_empty();
}

void Solver::Impl::start_empty() {
  lay_blocks();
  states = std::vector<BlockState>(mesh.blocks().size());
  for (std::size_t k = 0; k < states.size(); ++k) size(states[k], mesh.blocks()[k]);
  deal();
}

void Solver::Impl::lay_blocks() {
  const std::size_t n = mesh.blocks().size();
  ghosts.emplace(mesh, settings.sides);
  ghosts->extend(mesh);
  steepest = mesh.steepest();
  faces.assign(n, {});
  across.assign(n, {});
  inflow_block.assign(n, 0);
  tallies.resize(n);
  touched.assign(n, 0);
  changed.assign(n, 0);
  before.resize(settings.refinement.empty() ? 0 : n);
  levels.assign(1, {});
  int largest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Block& b = mesh.blocks()[k];
    if (static_cast<int>(levels.size()) <= b.level) levels.resize(b.level + 1);
    levels[b.level].blocks.push_back(static_cast<int>(k));
    faces[k].steps = StepFaces(b);
    faces[k].pushed = PushedCells(b);
    largest = std::max(largest, b.size());
    const auto comes_in = [&](const Side& side) {
      return side.kind == Side::Kind::inflow && fastest_inflow(side, settings.gravity, 0) > 0;
    };
    const bool at_side[] = {b.i0 == 0, b.i0 + b.nx == b.grid.nx, b.j0 == 0, b.j0 + b.ny == b.grid.ny};
    for (int side = 0; side < 4; ++side) {
      if (at_side[side] && comes_in(settings.sides[side])) inflow_block[k] = 1;
    }
  }
  for (Scratch& w : scratch) w.resize(largest);
  lay_level_faces();
}

void Solver::Impl::size(BlockState& s, const Block& b) const {
  s.now.resize(b.size());
  s.start.resize(b.size());
  if (with_earth_pressure(parameters)) {
    s.passive_x.assign(b.size(), 0.0);
    s.passive_y.assign(b.size(), 0.0);
  }
  s.open.assign(b.size(), 1.0);
}

// Where a block's ghost beside a face lies among finer cells: the two faces of theirs.
void Solver::Impl::lay_level_faces() {
  beside_finer.assign(mesh.blocks().size(), 0);
  for (std::size_t n = 0; n < mesh.blocks().size(); ++n) {
    const Block& b = mesh.blocks()[n];
    const int k = static_cast<int>(n), row = b.row();
    for (const Ghosts::Copy& c : ghosts->finer(k)) {
      beside_finer[n] = 1;
      const auto [i, j] = b.local(c.to);
      const bool in_rows = j >= 0 && j < b.ny, in_columns = i >= 0 && i < b.nx;
      const bool low_x = i == -1 && in_rows, high_x = i == b.nx && in_rows, low_y = j == -1 && in_columns,
                 high_y = j == b.ny && in_columns;
      if (!(low_x || high_x || low_y || high_y)) continue;
      const bool along_x = low_x || high_x, finer_above = high_x || high_y;
      const int finer_row = mesh.blocks()[c.from.block].row();
      const int up = along_x ? 1 : finer_row, aside = along_x ? finer_row : 1;
      const int first = c.from.cell + (finer_above ? 0 : 2 * up), slot = static_cast<int>(across[n].size());
      faces[n].taken.push_back({finer_above ? c.to : c.to + (along_x ? 1 : row), along_x, finer_above, slot});
      for (int part : {0, 1}) faces[c.from.block].given.push_back({first + part * aside, along_x, finer_above, k, slot});
      across[n].push_back({});
    }
  }
}

// Each face belongs to the block of the cell above it, the last one to the last block.
void Solver::Impl::lay_gauge(int id) {
  const Gauge& g = gauges[id];
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Block& b = mesh.blocks()[n];
    const bool last = b.i0 + b.nx == b.grid.nx;
    const int i = (g.i << b.level) - b.i0, j0 = std::max((g.j0 << b.level) - b.j0, 0),
              j1 = std::min((g.j1 << b.level) - b.j0, b.ny);
    if (i >= 0 && i < b.nx + (last ? 1 : 0) && j0 < j1) faces[n].gauges.push_back({id, i, j0, j1});
  }
}

void Solver::Impl::lay_box(int id) {
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Block& b = mesh.blocks()[n];
    const CellBox& c = boxes[id].cells;
    const CellBox box{c.i0 << b.level, c.i1 << b.level, c.j0 << b.level, c.j1 << b.level};
    const int i0 = std::max(box.i0 - b.i0, 0), i1 = std::min(box.i1 - b.i0, b.nx);
    const int j0 = std::max(box.j0 - b.j0, 0), j1 = std::min(box.j1 - b.j0, b.ny);
    if (i0 >= i1 || j0 >= j1) continue;
    faces[n].boxes.push_back(
        {id, i0, i1, j0, j1, {b.i0 + i0 == box.i0, b.i0 + i1 == box.i1, b.j0 + j0 == box.j0, b.j0 + j1 == box.j1}});
  }
}

std::array<double, 2> Solver::Impl::momentum() const {
  std::array<double, 2> sum{};
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!states[k].wet) continue;  // films have none
    sum[0] += open_sum(static_cast<int>(k), states[k].now.hu), sum[1] += open_sum(static_cast<int>(k), states[k].now.hv);
  }
  return sum;
}

// By columns, so that rows of any vector's width give the same bits.
double Solver::Impl::open_sum(int block, const std::vector<double>& of) const {
  const Block& b = mesh.blocks()[block];
  const double* open = states[block].open.data();
  std::vector<double> columns(b.nx, 0.0);
  for (int j = 0; j < b.ny; ++j) {
    const int c = b.at(0, j);
    for (int i = 0; i < b.nx; ++i) columns[i] += open[c + i] * of[c + i];
  }
  double sum = 0;
  for (double column : columns) sum += column;
  return sum * b.grid.dx * b.grid.dy;
}

std::array<double, 2> Solver::Impl::momentum_in(const CellBox& box) const {
  std::array<double, 2> sum{};
  for (int j = box.j0; j < box.j1; ++j) {
    for (int i = box.i0; i < box.i1; ++i) {
      const FlowState q = get(i, j);
      sum[0] += q.hu, sum[1] += q.hv;
    }
  }
  const double area = settings.grid.dx * settings.grid.dy;
  return {sum[0] * area, sum[1] * area};
}

void Solver::Impl::put_in(int block, int cell, const FlowState& q) {
  BlockState& s = states[block];
  const bool moves = q.h >= settings.dry_depth || std::isnan(q.h);
  s.now.h[cell] = q.h;
  s.now.hu[cell] = moves ? q.hu : 0.0;
  s.now.hv[cell] = moves ? q.hv : 0.0;
  if (!(q.h < settings.dry_depth)) s.wet |= mesh.blocks()[block].places_of(cell);
  rate.reset();
}

template <class F>
void Solver::Impl::for_cells_in(int i, int j, F&& f) const {
  const Mesh::Patch p = mesh.over(i, j);
  const Block& b = mesh.blocks()[p.block];
  for (int m = 0; m < p.n; ++m) {
    for (int n = 0; n < p.n; ++n) f(p.block, b.at(p.i + n, p.j + m));
  }
}

void Solver::Impl::put(int i, int j, const FlowState& q) {
  for_cells_in(i, j, [&](int k, int c) { put_in(k, c, q); });
}

FlowState Solver::Impl::get(int i, int j) const {
  FlowState sum;
  int n = 0;
  for_cells_in(i, j, [&](int k, int c) {
    const Fields& q = states[k].now;
    sum.h += q.h[c], sum.hu += q.hu[c], sum.hv += q.hv[c], ++n;
  });
  return {sum.h / n, sum.hu / n, sum.hv / n};
}

void Solver::Impl::add(int i, int j, const FlowState& more) {
  sync();
  for_cells_in(i, j, [&](int k, int c) {
    const Grid& g = mesh.blocks()[k].grid;
    const double area = g.dx * g.dy;
    Fields& q = states[k].now;
    const FlowState sum{q.h[c] + more.h, q.hu[c] + more.hu, q.hv[c] + more.hv};
    put_in(k, c, sum);
    budget.mass_added += area * more.h;
    const double wanted[] = {more.hu, more.hv}, lost[] = {q.hu[c] - sum.hu, q.hv[c] - sum.hv};
    for (int n : {0, 1}) budget.added[n] += area * wanted[n], budget.cutoff[n] += area * lost[n];
  });
}

std::vector<FlowState> Solver::Impl::along(SideName side, int i, int j) const {
  const Mesh::Patch p = mesh.over(i, j);
  const Block& b = mesh.blocks()[p.block];
  const Fields& q = states[p.block].now;
  const int at = is_low(side) ? 0 : p.n - 1;
  std::vector<FlowState> result(p.n);
  for (int m = 0; m < p.n; ++m) {
    const int c = is_across_x(side) ? b.at(p.i + at, p.j + m) : b.at(p.i + m, p.j + at);
    result[m] = {q.h[c], q.hu[c], q.hv[c]};
  }
  return result;
}

void Solver::Impl::set_active(int i, int j) {
  if (!with_earth_pressure(parameters)) return;
  for_cells_in(i, j, [&](int k, int c) { states[k].passive_x[c] = states[k].passive_y[c] = 0; });
  rate.reset();
}

std::array<double, 2> Solver::Impl::passive(int i, int j) const {
  std::array<double, 2> sum{};
  if (!with_earth_pressure(parameters)) return sum;
  int n = 0;
  for_cells_in(i, j, [&](int k, int c) { sum[0] += states[k].passive_x[c], sum[1] += states[k].passive_y[c], ++n; });
  return {sum[0] / n, sum[1] / n};
}

}  // namespace couloir
