// A step of the staggered scheme: to the corners and back.

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuum/errors.hpp"
#include "continuum/noc/noc_impl.hpp"

namespace couloir {
namespace {

constexpr int most_halvings = 40;  // of a step whose second half would break the CFL bound

constexpr int strip = 8;  // rows whose columns are summed together

// Sums over a region's rows, strip by strip; f(j, columns, rows).
template <class F>
std::vector<noc::RowSums> by_strips(const noc::Region& region, int columns, int threads, F&& f) {
  std::vector<noc::RowSums> sums((region.j1() - region.j0() + strip - 1) / strip);
#pragma omp parallel num_threads(threads)
  {
    noc::ColumnSums own;
#pragma omp for schedule(static)
    for (int s = 0; s < static_cast<int>(sums.size()); ++s) {
      own.clear(columns);
      const int begin = region.j0() + s * strip, end = std::min(begin + strip, region.j1());
      for (int j = begin; j < end; ++j) f(j, own, sums[s]);
      own.add_to(sums[s]);
    }
  }
  return sums;
}

}  // namespace

void NocSolver::Impl::step(double dt) {
  if (!(dt > 0)) throw std::invalid_argument("A step of the continuum needs a positive length in time.");
  const StepTimer::Span span(timer, steps);
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
  const StepTimer::Span span(timer, steps);
  if (scan) find_wet();
  set_inflow(time);
  refresh_state();
}

void NocSolver::Impl::refresh_state() {
  timer.lap(StepPart::order);
  centres.fill_ghosts();
  timer.lap(StepPart::ghosts);
  double fastest = centres.find_state(around);
  for (int side = 0; side < 4; ++side) {
    const double spacing = side < 2 ? settings.grid.dx : settings.grid.dy;
    fastest = std::max(fastest, fastest_inflow(sides[side], settings.gravity, time) / spacing);
  }
  rate = fastest;
  timer.lap(StepPart::rates);
}

void NocSolver::Impl::lay_regions() {
  const bool x = periodic(0), y = periodic(1);
  near = wet.grown(1, x, y), around = wet.grown(4, x, y);
  near_corners = near.corners(y), corner_region = wet.grown(3, x, y).corners(y);
}

std::pair<int, int> NocSolver::Impl::inner(const Region& corners, int j) const {
  const Grid& g = settings.grid;
  const int first = periodic(0) ? 0 : 1, first_row = periodic(1) ? 0 : 1;
  if (j < first_row || j >= g.ny) return {corners.end(j), corners.end(j)};
  const int low = std::max(corners.begin(j), first);
  return {low, std::max(low, std::min(corners.end(j), g.nx))};
}

void NocSolver::Impl::copy_twins(int j) {
  const Grid& g = settings.grid;
  const auto copy = [&](int from, int to) {
    for (double* a : {corners.q.h, corners.q.hu, corners.q.hv, corners.locked, corners.lost_x, corners.lost_y}) a[to] = a[from];
  };
  if (periodic(0)) copy(corners.at(0, j), corners.at(g.nx, j));
  for (int i = 0; periodic(1) && j == 0 && i <= g.nx; ++i) copy(corners.at(i, 0), corners.at(i, g.ny));
}

bool NocSolver::Impl::half_step_to_corners(double tau) {
  timer.lap(StepPart::order);
  make_inflow(tau);
  timer.lap(StepPart::sides);
  find_locked();
  timer.lap(StepPart::rest);
  centres.prepare(around, tau);
  centres.wrap_points();
  timer.lap(StepPart::reconstruction);
  limit_corners();
  const noc::Drag met = drag();
  first = by_strips(corner_region, settings.grid.nx + 1, settings.threads, [&](int j, noc::ColumnSums& columns, RowSums& sums) {
    const auto [low, high] = inner(corner_region, j);
    receive_at_corners(corners, centres, terrain, met, j, low, high, tau, columns);
    for_outer(corner_region, j, [&](int i) { update_corner(i, j, tau, sums); });
    copy_twins(j);
  });
  timer.lap(StepPart::update);
  corners.fill_ghosts();
  timer.lap(StepPart::ghosts);
  const double fastest = corners.find_state(near_corners);
  timer.lap(StepPart::rates);
  if (fastest * tau > 0.5 * (1 + 1e-12)) return false;
  corners.prepare(near_corners, tau);
  timer.lap(StepPart::reconstruction);
  return true;
}

void NocSolver::Impl::half_step_to_centres(double tau) {
  const Grid& g = settings.grid;
  limit_centres();
  timer.lap(StepPart::update);
  count_obstacles(centres, corner_region, tau);
  count_obstacles(corners, near, tau);
  timer.lap(StepPart::bed);
  count_sides();
  timer.lap(StepPart::sides);
  count_gauges();
  count_boxes(HalfStep::to_corners, tau);
  timer.lap(StepPart::measures);
  const noc::Drag met = drag();
  const auto rows = by_strips(near, g.nx, settings.threads, [&](int j, noc::ColumnSums& columns, RowSums& sums) {
    const int begin = near.begin(j), end = near.end(j);
    if (!periodic(1) && (j == 0 || j == g.ny - 1)) {
      for (int i = begin; i < end; ++i) book_centre(i, j, sums);
    } else if (!periodic(0)) {
      if (begin == 0 && end > 0) book_centre(0, j, sums);
      if (end == g.nx && g.nx > 1) book_centre(g.nx - 1, j, sums);
    }
    receive_at_centres(centres, corners, terrain, met, j, begin, end, tau, columns);
  });
  timer.lap(StepPart::update);
  count_boxes(HalfStep::to_centres, tau);
  timer.lap(StepPart::measures);
  collect(first);
  collect(rows);
  put_inflow_right(2 * tau);
  cell_updates += corner_region.count() + near.count();
  find_wet();
}

// In the cells that may have changed, or in all of them after others were set.
void NocSolver::Impl::find_wet() {
  const Grid& g = settings.grid;
  Region found(g.nx, g.ny);
  const auto dry = [&](int i, int j) { return centres.q.h[centres.at(i, j)] < settings.dry_depth; };  // not a number is wet
  for (int j = scan ? 0 : near.j0(); j < (scan ? g.ny : near.j1()); ++j) {
    int begin = scan ? 0 : near.begin(j), end = scan ? g.nx : near.end(j);
    while (begin < end && dry(begin, j)) ++begin;
    while (begin < end && dry(end - 1, j)) --end;
    found.add(j, begin, end);
  }
  scan = false;
  wet = std::move(found);
  wet_inflow();
  lay_regions();
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
