#include "continuum/scheme/update.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "continuum/flow/flux.hpp"
#include "continuum/flow/friction.hpp"
#include "continuum/scheme/effects.hpp"

namespace couloir {
namespace {

// Sums by column: added row after row they vectorise, and their order is fixed.
enum Column { gravity_x, gravity_y, friction_x, friction_y, cutoff_x, cutoff_y, clipped, least, most, not_finite, column_count };

void clear(std::vector<Values>& columns, int nx) {
  columns.resize(column_count);
  for (auto& c : columns) c.assign(nx, 0.0);
  std::fill(columns[least].begin(), columns[least].end(), std::numeric_limits<double>::infinity());
}

double sum(const Values& values) {
  double s = 0;
  for (double v : values) s += v;
  return s;
}

// The force on the two halves of a cell along one axis: weight, bed and the pressure from its middle to its face. Where both
// cells at a face are locked, friction holds that half, whatever it takes: else a deposit would push, through a face that no
// mass passes, a film beside it to any speed.
struct Halves {
  double force, held;
};
inline Halves halves(double lower, double upper, bool lower_locked, bool upper_locked) {
  const double free_lower = lower_locked ? 0.0 : lower, free_upper = upper_locked ? 0.0 : upper;
  return {free_lower + free_upper, (lower - free_lower) + (upper - free_upper)};
}

// What a kernel does is told by the bits of one number. is_free: all cells are the solver's own and none is locked, both sides
// of each face see the same flux unless there are sources, and nobody asks for the losses.
constexpr unsigned has_friction = 1, has_earth_pressure = 2, has_sources = 4, is_free = 8, kernel_count = 16;

template <StageName stage, unsigned does>
void update_row(const Parameters& p, const Block& b, BlockState& s, Scratch& w, double dt, int j) {
  constexpr bool friction = does & has_friction, earth_pressure = does & has_earth_pressure, sources = does & has_sources,
                 free = does & is_free, one_flux = free && !sources;
  const int row = b.row(), begin = b.at(0, j);
  const double per_dx = 1 / b.grid.dx, per_dy = 1 / b.grid.dy, mu = p.closure.tan_delta, dry = p.dry_depth;
  double *h = s.now.h.data(), *hu = s.now.hu.data(), *hv = s.now.hv.data();
  double *h0 = s.start.h.data(), *hu0 = s.start.hu.data(), *hv0 = s.start.hv.data();
  const double *open = s.open.data(), *loose = w.loose.data(), *u = w.u.data(), *kx = w.kx.data(), *ky = w.ky.data();
  const double *x_mass = w.x.mass.data(), *x_normal = w.x.normal.data(), *x_below = one_flux ? x_normal : w.x.normal_below.data(),
               *x_above = one_flux ? x_normal : w.x.normal_above.data(), *x_tangent = w.x.tangent.data();
  const double *y_mass = w.y.mass.data(), *y_normal = w.y.normal.data(), *y_below = one_flux ? y_normal : w.y.normal_below.data(),
               *y_above = one_flux ? y_normal : w.y.normal_above.data(), *y_tangent = w.y.tangent.data();
  const double *source_x = w.source_x.data(), *source_y = w.source_y.data();
  const double *weight = b.weight.data() + Block::ghosts, *drive = b.drive.data() + Block::ghosts,
               *kappa = b.kappa.data() + Block::ghosts;
  double *sum_gx = w.columns[gravity_x].data(), *sum_gy = w.columns[gravity_y].data();
  double *sum_fx = w.columns[friction_x].data(), *sum_fy = w.columns[friction_y].data();
  double *sum_cx = w.columns[cutoff_x].data(), *sum_cy = w.columns[cutoff_y].data();
  double *sum_clip = w.columns[clipped].data(), *min_h = w.columns[least].data(), *max_h = w.columns[most].data();
  double* bad = w.columns[not_finite].data();
  double *kept_x = w.lost_x.data(), *kept_y = w.lost_y.data();

#pragma omp simd
  for (int i = 0; i < b.nx; ++i) {
    const int c = begin + i;
    const bool active = free || open[c] != 0;
    const double old_h = h[c], old_hu = hu[c], old_hv = hv[c];

    // Flux differences and sources.
    const double raw_h = old_h - dt * ((x_mass[c + 1] - x_mass[c]) * per_dx + (y_mass[c + row] - y_mass[c]) * per_dy);
    const double push_x = old_h * drive[i] + (sources ? source_x[c] : 0.0), push_y = sources ? source_y[c] : 0.0;
    const double x_by_y = (y_tangent[c + row] - y_tangent[c]) * per_dy, y_by_x = (x_tangent[c + 1] - x_tangent[c]) * per_dx;
    const double mid_x = pressure(old_h, (earth_pressure ? kx[c] : 1.0) * weight[i]),
                 mid_y = pressure(old_h, (earth_pressure ? ky[c] : 1.0) * weight[i]);
    const Halves x = halves(0.5 * push_x + (x_above[c] - mid_x) * per_dx, 0.5 * push_x - (x_below[c + 1] - mid_x) * per_dx,
                            !free && loose[c] + loose[c - 1] == 0, !free && loose[c] + loose[c + 1] == 0);
    const Halves y = halves(0.5 * push_y + (y_above[c] - mid_y) * per_dy, 0.5 * push_y - (y_below[c + row] - mid_y) * per_dy,
                            !free && loose[c] + loose[c - row] == 0, !free && loose[c] + loose[c + row] == 0);
    const double free_hu = old_hu + dt * (x.force - x_by_y), free_hv = old_hv + dt * (y.force - y_by_x);

    // Friction. A locked cell among locked cells is held whatever the rounding says.
    const bool held = !free && loose[c] + loose[c - 1] + loose[c + 1] + loose[c - row] + loose[c + row] == 0;
    double factor = held ? 0.0 : 1.0;
    if constexpr (friction) {
      const double capacity = coulomb_capacity(dt, mu, weight[i], built::curvature ? kappa[i] : 0.0, u[c], old_h);
      factor = held ? 0.0 : coulomb_factor(std::sqrt(free_hu * free_hu + free_hv * free_hv), capacity);
    }
    double new_hu = free_hu * factor, new_hv = free_hv * factor;
    double lost_x = 0.5 * ((new_hu - free_hu) - dt * x.held), lost_y = 0.5 * ((new_hv - free_hv) - dt * y.held);

    // Depth: clipped as the last resort; no momentum in a film.
    double new_h = std::max(raw_h, 0.0);
    const bool film = new_h < dry;
    double dropped_x = film ? -0.5 * new_hu : 0.0, dropped_y = film ? -0.5 * new_hv : 0.0;
    new_hu = film ? 0.0 : new_hu;
    new_hv = film ? 0.0 : new_hv;

    if constexpr (stage == StageName::predictor) {
      h0[c] = old_h, hu0[c] = old_hu, hv0[c] = old_hv;
    } else {
      new_h = 0.5 * (h0[c] + new_h);
      new_hu = 0.5 * (hu0[c] + new_hu);
      new_hv = 0.5 * (hv0[c] + new_hv);
      const double whole_factor = old_h >= dry ? factor : 1.0;  // a film has nothing to say about the whole step
      const bool stopped = whole_factor == 0;
      lost_x -= stopped ? new_hu : 0.0;
      lost_y -= stopped ? new_hv : 0.0;
      new_hu = stopped ? 0.0 : new_hu;
      new_hv = stopped ? 0.0 : new_hv;
      const bool thin = new_h < dry;
      dropped_x -= thin ? new_hu : 0.0;
      dropped_y -= thin ? new_hv : 0.0;
      new_hu = thin ? 0.0 : new_hu;
      new_hv = thin ? 0.0 : new_hv;
    }

    h[c] = active ? new_h : old_h;
    hu[c] = active ? new_hu : old_hu;
    hv[c] = active ? new_hv : old_hv;

    // Sums.
    const double bed_x = one_flux ? 0.0 : (x_above[c] - x_normal[c]) - (x_below[c + 1] - x_normal[c + 1]);
    const double bed_y = one_flux ? 0.0 : (y_above[c] - y_normal[c]) - (y_below[c + row] - y_normal[c + row]);
    sum_gx[i] += active ? 0.5 * dt * (push_x + bed_x * per_dx) : 0.0;
    if constexpr (!one_flux) sum_gy[i] += active ? 0.5 * dt * (push_y + bed_y * per_dy) : 0.0;
    if constexpr (friction || !free) {
      sum_fx[i] += active ? lost_x : 0.0;
      sum_fy[i] += active ? lost_y : 0.0;
    }
    if constexpr (!free) {
      kept_x[c] = active ? lost_x + dropped_x : 0.0;
      kept_y[c] = active ? lost_y + dropped_y : 0.0;
    }
    sum_cx[i] += active ? dropped_x : 0.0;
    sum_cy[i] += active ? dropped_y : 0.0;
    sum_clip[i] += active && raw_h < 0 ? -0.5 * raw_h : 0.0;
    min_h[i] = std::min(min_h[i], active ? raw_h : std::numeric_limits<double>::infinity());
    max_h[i] = std::max(max_h[i], h[c]);
    const double all = raw_h + h[c] + hu[c] + hv[c];
    bad[i] += all - all;  // 0, or not a number
  }
}

using Row = void (*)(const Parameters&, const Block&, BlockState&, Scratch&, double dt, int j);

template <StageName stage, unsigned... does>
constexpr std::array<Row, kernel_count> kernels(std::integer_sequence<unsigned, does...>) {
  return {update_row<stage, does>...};
}
// By stage and by what they do.
constexpr auto predictors = kernels<StageName::predictor>(std::make_integer_sequence<unsigned, kernel_count>());
constexpr auto correctors = kernels<StageName::corrector>(std::make_integer_sequence<unsigned, kernel_count>());

// deepest: of each column.
WetPlaces wet_places(const Block& b, const BlockState& s, const double* deepest, double dry_depth) {
  const auto wet = [&](const double* from, int count) { return count > 0 && *std::max_element(from, from + count) >= dry_depth; };
  if (!wet(deepest, b.nx)) return 0;
  const int deep = std::min(Block::ghosts, std::min(b.nx, b.ny));
  WetPlaces places = wet_inside;
  if (wet(deepest, deep)) places |= wet_upstream;
  if (wet(deepest + b.nx - deep, deep)) places |= wet_downstream;
  for (int n = 0; n < deep; ++n) {
    if (wet(&s.now.h[b.at(0, n)], b.nx)) places |= wet_right;
    if (wet(&s.now.h[b.at(0, b.ny - 1 - n)], b.nx)) places |= wet_left;
  }
  return places;
}

}  // namespace

void update(const Parameters& p, const Block& b, BlockState& s, Scratch& w, StageName stage, double dt, bool sources,
            bool keep_losses, Tally& t) {
  clear(w.columns, b.nx);
  const bool free = s.all_open && !w.locked && (sources || w.one_flux) && !keep_losses;
  const unsigned does = (with_friction(p) ? has_friction : 0) | (with_earth_pressure(p) ? has_earth_pressure : 0) |
                        (sources ? has_sources : 0) | (free ? is_free : 0);
  const Row row = (stage == StageName::predictor ? predictors : correctors)[does];
  for (int j = 0; j < b.ny; ++j) row(p, b, s, w, dt, j);
  const double area = b.grid.dx * b.grid.dy;
  t.budget.gravity[0] += area * sum(w.columns[gravity_x]);
  t.budget.gravity[1] += area * sum(w.columns[gravity_y]);
  t.budget.friction[0] += area * sum(w.columns[friction_x]);
  t.budget.friction[1] += area * sum(w.columns[friction_y]);
  t.budget.cutoff[0] += area * sum(w.columns[cutoff_x]);
  t.budget.cutoff[1] += area * sum(w.columns[cutoff_y]);
  t.budget.mass_clipped += area * sum(w.columns[clipped]);
  t.min_depth = std::min(t.min_depth, *std::min_element(w.columns[least].begin(), w.columns[least].end()));
  const bool finite = sum(w.columns[not_finite]) == 0;
  t.finite = t.finite && finite;
  t.cell_updates += static_cast<std::int64_t>(b.nx) * b.ny;
  s.wet = finite ? wet_places(b, s, w.columns[most].data(), p.dry_depth) : wet_everywhere;
}

}  // namespace couloir
