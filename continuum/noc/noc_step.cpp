// A step of the staggered scheme: to the corners and back.

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuum/errors.hpp"
#include "continuum/noc/noc_impl.hpp"

namespace couloir {
namespace {

constexpr int most_halvings = 40;  // of a step whose second half would break the CFL bound

CellBox corners_of(const CellBox& cells) {
  return {cells.i0, cells.i1 + 1, cells.j0, cells.j1 + 1};
}
std::int64_t count(const CellBox& b) {
  return static_cast<std::int64_t>(b.i1 - b.i0) * (b.j1 - b.j0);
}

}  // namespace

void NocSolver::Impl::step(double dt) {
  if (!(dt > 0)) throw std::invalid_argument("A step of the continuum needs a positive length in time.");
  dt = std::min(dt, stable_dt());
  const double row = next_row(sides, time);
  double end = row - time <= dt ? row : time + dt;
  dt = std::min(dt, row - time);
  // A pair sees the inflow of its middle.
  if (set_inflow(time + 0.5 * dt)) rate.reset(), refresh_state();
  if (!wet.empty()) {
    for (int halvings = 0; !half_step_to_corners(0.5 * dt); ++halvings) {
      if (halvings == most_halvings)
        throw NumericsError("The continuum's time step fell below any use at t = " + std::to_string(time) +
                            " s: the flow speeds up without bound; check the bed's slopes, or use scheme central_upwind.");
      dt *= 0.5;
      end = time + dt;
      if (set_inflow(time + 0.5 * dt)) refresh_state();
    }
    half_step_to_centres(0.5 * dt);
    rate.reset();
  }
  time = end;
  ++steps;
}

double NocSolver::Impl::stable_dt() {
  refresh();
  const double r = *rate, a = terrain.steepest() / std::min(settings.grid.dx, settings.grid.dy);
  if (!(r > 0) && a == 0) return std::numeric_limits<double>::max();
  return 2 * (2 * settings.cfl / (r + std::sqrt(r * r + 4 * a * settings.cfl)));
}

void NocSolver::Impl::refresh() {
  if (rate) return;
  if (scan) find_wet({0, settings.grid.nx, 0, settings.grid.ny});
  scan = false;
  set_inflow(time);
  refresh_state();
}

void NocSolver::Impl::refresh_state() {
  centres.fill_ghosts();
  double fastest = centres.find_state(window(4));
  for (int side = 0; side < 4; ++side) {
    const double spacing = side < 2 ? settings.grid.dx : settings.grid.dy;
    fastest = std::max(fastest, fastest_inflow(sides[side], settings.gravity, time) / spacing);
  }
  rate = fastest;
}

CellBox NocSolver::Impl::window(int margin) const {
  if (wet.empty()) return wet;
  const Grid& g = settings.grid;
  CellBox b{wet.i0 - margin, wet.i1 + margin, wet.j0 - margin, wet.j1 + margin};
  if (settings.sides[0].kind == Side::Kind::periodic && (b.i0 < 0 || b.i1 > g.nx)) b.i0 = 0, b.i1 = g.nx;
  if (settings.sides[2].kind == Side::Kind::periodic && (b.j0 < 0 || b.j1 > g.ny)) b.j0 = 0, b.j1 = g.ny;
  return centres.clamp(b);
}

bool NocSolver::Impl::half_step_to_corners(double tau) {
  const CellBox cells = window(4);
  corner_box = corners_of(window(3));
  make_inflow(tau);
  find_locked(cells);
  centres.prepare(cells, tau);
  limit_corners(corner_box);
  first.assign(corner_box.j1 - corner_box.j0, {});
#pragma omp parallel for num_threads(settings.threads) schedule(static)
  for (int j = corner_box.j0; j < corner_box.j1; ++j) {
    for (int i = corner_box.i0; i < corner_box.i1; ++i) update_corner(i, j, tau, first[j - corner_box.j0]);
  }
  corners.fill_ghosts();
  const CellBox inner = corners_of(window(1));
  if (corners.find_state(inner) * tau > 0.5 * (1 + 1e-12)) return false;
  corners.prepare(inner, tau);
  return true;
}

void NocSolver::Impl::half_step_to_centres(double tau) {
  const CellBox cells = window(1);
  limit_centres(cells);
  count_obstacles(centres, corner_box, tau);
  count_obstacles(corners, cells, tau);
  count_sides(corners_of(cells));
  count_gauges(corners_of(cells));
  count_boxes(cells, tau);
  std::vector<RowSums> rows(cells.j1 - cells.j0);
#pragma omp parallel for num_threads(settings.threads) schedule(static)
  for (int j = cells.j0; j < cells.j1; ++j) {
    for (int i = cells.i0; i < cells.i1; ++i) update_centre(i, j, tau, rows[j - cells.j0]);
  }
  collect(first);
  collect(rows);
  put_inflow_right(2 * tau);
  cell_updates += count(corner_box) + count(cells);
  find_wet(cells);
}

void NocSolver::Impl::find_wet(const CellBox& cells) {
  const Grid& g = settings.grid;
  CellBox found{g.nx, 0, g.ny, 0};
  for (int j = cells.j0; j < cells.j1; ++j) {
    for (int i = cells.i0; i < cells.i1; ++i) {
      if (centres.q.h[centres.at(i, j)] < settings.dry_depth) continue;  // not a number counts as wet
      found = {std::min(found.i0, i), std::max(found.i1, i + 1), std::min(found.j0, j), std::max(found.j1, j + 1)};
    }
  }
  wet = found;
  wet_inflow();
}

void NocSolver::Impl::collect(const std::vector<RowSums>& rows) {
  const double area = settings.grid.dx * settings.grid.dy;
  Budget sum;
  bool finite = true;
  for (const RowSums& r : rows) {
    sum.add(r.budget);
    min_depth = min_depth_met ? std::min(min_depth, r.min_depth) : r.min_depth;
    min_depth_met = true;
    finite = finite && r.finite;
  }
  for (int k : {0, 1}) {
    budget.gravity[k] += area * sum.gravity[k];
    budget.friction[k] += area * sum.friction[k];
    budget.boundary[k] += area * sum.boundary[k];
    budget.cutoff[k] += area * sum.cutoff[k];
    for (int side = 0; side < 4; ++side) budget.sides[side][k] += area * sum.sides[side][k];
  }
  if (!finite) check_finite();
}

}  // namespace couloir
