#include "continuum/noc/noc_solver.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "continuum/bytes.hpp"
#include "continuum/errors.hpp"
#include "continuum/noc/noc_impl.hpp"

namespace couloir {
namespace {

constexpr std::uint64_t signature = 0x33636f6e6c756f63;  // changes with the layout

void check(const SolverSettings& s, const NocSettings& own, const ReferenceSurface& surface) {
  const auto require = [](bool good, const char* sentence) {
    if (!good) throw std::invalid_argument(sentence);
  };
  const Grid& g = s.grid;
  require(g.nx > 0 && g.ny > 0, "The grid needs at least one cell in x and in y; enlarge the terrain or refine the cell.");
  require(g.dx > 0 && g.dy > 0, "The cells need a positive size; correct continuum.cell.");
  require(s.gravity > 0, "The gravity must be positive; correct the scene.");
  require(s.cfl > 0 && s.cfl <= 0.5,
          "The CFL number of the scheme noc must be above 0 and at most 0.5, equation (3.22); lower continuum.cfl.");
  require(s.dry_depth > 0, "The dry depth must be positive; correct the settings.");
  require(s.refinement.empty(), "One grid of the scheme noc has no refined boxes; use nested grids.");
  require(s.threads >= 1, "The continuum needs at least one thread; correct the number of threads.");
  require(own.creeping_froude >= 0, "The Froude number of creep must not be negative; correct the settings.");
  require(s.closure.tan_delta >= 0, "The basal friction must not be negative; correct the material.");
  require(!(surface.curved() && s.sides[0].kind == Side::Kind::periodic),
          "A surface with an arc cannot be periodic along the slope; choose other sides upstream and downstream.");
  for (int low : {0, 2}) {
    require((s.sides[low].kind == Side::Kind::periodic) == (s.sides[low + 1].kind == Side::Kind::periodic),
            low == 0 ? "Only one of the sides upstream and downstream is periodic; make both periodic or neither."
                     : "Only one of the sides left and right is periodic; make both periodic or neither.");
  }
  for (const Side& side : s.sides) {
    for (const InflowPoint& p : side.hydrograph)
      require(p.depth >= 0 && p.velocity >= 0, "An inflow's hydrograph needs depths and velocities that are not negative.");
    require(side.kind != Side::Kind::inflow || (side.depth >= 0 && side.velocity >= 0),
            "An inflow side needs a depth and an inward velocity that are not negative; correct the boundary.");
  }
}

void require_cell(const Grid& g, int i, int j) {
  if (i >= 0 && j >= 0 && i < g.nx && j < g.ny) return;
  std::ostringstream text;
  text << "There is no cell (" << i << ", " << j << ") in a grid of " << g.nx << " x " << g.ny << " cells.";
  throw std::out_of_range(text.str());
}

}  // namespace

NocSolver::Impl::Impl(const SolverSettings& s, const ReferenceSurface& surface, const NocBed& bed, const NocSettings& own)
    : settings((check(s, own, surface), s)),
      sides(s.sides),
      terrain(s.grid, surface, bed, s.gravity, s.closure.curvature),
      centres(Lattice::Kind::centres, settings, own, terrain),
      corners(Lattice::Kind::corners, settings, own, terrain),
      wet(s.grid.nx, s.grid.ny),
      impulse(bed.obstacles.size()) {
  lay_lines();
  for (int side = 0; side < 4; ++side) {
    if (sides[side].kind != Side::Kind::inflow) continue;
    const int cells = side < 2 ? s.grid.ny : s.grid.nx;
    inflow_entered[side].assign(cells + 1, 0.0);
    inflow_owed[side].assign(cells, 0.0);
  }
}

void NocSolver::Impl::lay_lines() {
  lines_x.clear(), lines_y.clear();
  for (int i = 0; i <= settings.grid.nx; ++i) {
    for (int which : {0, 1}) lines_x.push_back(line(i, which, settings.grid.nx, 0));
  }
  for (int j = 0; j <= settings.grid.ny; ++j) {
    for (int which : {0, 1}) lines_y.push_back(line(j, which, settings.grid.ny, 2));
  }
}

void NocSolver::Impl::check_finite() const {
  check_finite_cells(settings.grid, time, steps, "released", [&](int i, int j) { return get(i, j); });
}

void NocSolver::Impl::put(int i, int j, const FlowState& q) {
  const int c = centres.at(i, j);
  const bool film = q.h < settings.dry_depth;
  centres.q.h[c] = q.h;
  centres.q.hu[c] = film ? 0.0 : q.hu;
  centres.q.hv[c] = film ? 0.0 : q.hv;
  scan = true;
  rate.reset();
}

FlowState NocSolver::Impl::get(int i, int j) const {
  const int c = centres.at(i, j);
  return {centres.q.h[c], centres.q.hu[c], centres.q.hv[c]};
}

NocSolver::NocSolver(const SolverSettings& settings, const ReferenceSurface& surface, const NocBed& bed, const NocSettings& own)
    : impl_(std::make_unique<Impl>(settings, surface, bed, own)) {}
NocSolver::~NocSolver() = default;
NocSolver::NocSolver(NocSolver&&) noexcept = default;

const Grid& NocSolver::grid() const {
  return impl_->settings.grid;
}
double NocSolver::time() const {
  return impl_->time;
}
void NocSolver::set_time(double t) {
  impl_->time = t;
}
PartTimes NocSolver::part_times() const {
  return impl_->timer.times();
}
std::int64_t NocSolver::steps() const {
  return impl_->steps;
}
std::int64_t NocSolver::cell_updates() const {
  return impl_->cell_updates;
}

void NocSolver::set(const std::function<FlowState(double x, double y)>& state) {
  const Grid& g = grid();
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) impl_->put(i, j, state(g.x(i), g.y(j)));
  }
}

void NocSolver::set(int i, int j, const FlowState& q) {
  require_cell(grid(), i, j);
  impl_->put(i, j, q);
}

FlowState NocSolver::at(int i, int j) const {
  require_cell(grid(), i, j);
  return impl_->get(i, j);
}

void NocSolver::gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const {
  const Grid& g = grid();
  h.clear(), hu.clear(), hv.clear();
  for (int j = 0; j < g.ny; ++j) {
    const int begin = impl_->centres.at(0, j);
    const noc::Three& q = impl_->centres.q;
    h.insert(h.end(), &q.h[begin], &q.h[begin] + g.nx);
    hu.insert(hu.end(), &q.hu[begin], &q.hu[begin] + g.nx);
    hv.insert(hv.end(), &q.hv[begin], &q.hv[begin] + g.nx);
  }
}

void NocSolver::replace(const CellBox& cells, const std::function<FlowState(int i, int j)>& state) {
  impl_->replace(cells, state);
}

void NocSolver::count_forces_in(const CellBox& cells, const std::vector<CellBox>& others) {
  impl_->count_forces_in(cells, others);
}

double NocSolver::volume() const {
  double sum = 0;
  for (int j = 0; j < grid().ny; ++j) {
    for (int i = 0; i < grid().nx; ++i) sum += impl_->get(i, j).h;
  }
  return sum * grid().dx * grid().dy;
}

std::array<double, 2> NocSolver::momentum() const {
  double x = 0, y = 0;
  for (int j = 0; j < grid().ny; ++j) {
    for (int i = 0; i < grid().nx; ++i) {
      const FlowState q = impl_->get(i, j);
      x += q.hu, y += q.hv;
    }
  }
  const double area = grid().dx * grid().dy;
  return {x * area, y * area};
}

double NocSolver::min_depth() const {
  return impl_->min_depth;
}

double NocSolver::max_speed() const {
  double fastest = 0;
  for (int j = 0; j < grid().ny; ++j) {
    for (int i = 0; i < grid().nx; ++i) {
      const FlowState q = impl_->get(i, j);
      if (q.h >= impl_->settings.dry_depth) fastest = std::max(fastest, std::hypot(q.hu, q.hv) / q.h);
    }
  }
  return fastest;
}

double NocSolver::stable_dt() const {
  return impl_->stable_dt();
}
void NocSolver::step(double dt) {
  impl_->step(dt);
}

std::array<double, 2> NocSolver::obstacle_impulse(int id) const {
  return impl_->impulse.at(id);
}

int NocSolver::add_control_box(const CellBox& box) {
  const Grid& g = grid();
  if (box.empty() || box.i0 < 0 || box.j0 < 0 || box.i1 > g.nx || box.j1 > g.ny) {
    throw std::out_of_range("A control box needs cells, and all of them inside the grid; move it.");
  }
  impl_->boxes.push_back({box, impl_->momentum_in(box), {}});
  return static_cast<int>(impl_->boxes.size()) - 1;
}

std::array<double, 2> NocSolver::control_box_impulse(int id) const {
  const noc::ControlBox& box = impl_->boxes.at(id);
  const auto now = impl_->momentum_in(box.cells);
  std::array<double, 2> out;
  for (int k : {0, 1}) {
    out[k] = box.terms.faces[k] + box.terms.weight[k] + box.terms.friction[k] - (now[k] - box.before[k]);
  }
  return out;
}

int NocSolver::add_gauge(int i, int j0, int j1) {
  const Grid& g = grid();
  if (i < 0 || i > g.nx || j0 < 0 || j1 > g.ny || j0 >= j1) {
    throw std::out_of_range("A gauge needs an x-face and rows inside the grid; move it.");
  }
  impl_->gauges.push_back({i, j0, j1, 0.0});
  return static_cast<int>(impl_->gauges.size()) - 1;
}
double NocSolver::gauge(int id) const {
  return impl_->gauges.at(id).volume;
}

const Budget& NocSolver::budget() const {
  return impl_->budget;
}
void NocSolver::reset_budget() {
  impl_->budget = {};
}
std::int64_t NocSolver::limited() const {
  return impl_->limited_count;
}

std::vector<std::uint8_t> NocSolver::checkpoint() const {
  const Impl& m = *impl_;
  ByteWriter put;
  put(signature);
  put(m.settings.grid.nx), put(m.settings.grid.ny), put(static_cast<int>(m.impulse.size()));
  put(m.time), put(m.steps), put(m.cell_updates), put(m.limited_count), put(m.min_depth), put(m.min_depth_met);
  for (int j = 0; j < m.settings.grid.ny; ++j) {
    for (int i = 0; i < m.settings.grid.nx; ++i) put(m.get(i, j));
  }
  for (const auto& impulse : m.impulse) put(impulse);
  put_gauges(put, m.gauges);
  put(static_cast<int>(m.boxes.size()));
  for (const noc::ControlBox& b : m.boxes) put(b);
  for (const std::vector<double>& owed : m.inflow_owed) {
    for (const double depth : owed) put(depth);
  }
  put(m.budget);
  return std::move(put.bytes);
}

void NocSolver::restore(const std::vector<std::uint8_t>& bytes) {
  Impl& m = *impl_;
  ByteReader in(bytes);
  const bool ours = in.take<std::uint64_t>() == signature && in.take<int>() == m.settings.grid.nx &&
                    in.take<int>() == m.settings.grid.ny && in.take<int>() == static_cast<int>(m.impulse.size());
  if (!ours)
    throw std::invalid_argument(
        "The checkpoint belongs to another continuum (scheme, grid or obstacles differ); restore it with its own scene.");
  m.time = in.take<double>();
  m.steps = in.take<std::int64_t>();
  m.cell_updates = in.take<std::int64_t>();
  m.limited_count = in.take<std::int64_t>();
  m.min_depth = in.take<double>();
  m.min_depth_met = in.take<bool>();
  for (int j = 0; j < m.settings.grid.ny; ++j) {
    for (int i = 0; i < m.settings.grid.nx; ++i) m.put(i, j, in.take<FlowState>());
  }
  for (auto& impulse : m.impulse) impulse = in.take<std::array<double, 2>>();
  m.gauges = take_gauges(in);
  m.boxes.resize(in.take<int>());
  for (noc::ControlBox& b : m.boxes) b = in.take<noc::ControlBox>();
  for (std::vector<double>& owed : m.inflow_owed) {
    for (double& depth : owed) depth = in.take<double>();
  }
  m.budget = in.take<Budget>();
  if (!in.done()) throw std::invalid_argument("The continuum's checkpoint is longer than its state; restore an earlier one.");
}

}  // namespace couloir
