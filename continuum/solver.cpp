#include "continuum/solver.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "continuum/scheme/effects.hpp"
#include "continuum/solver_impl.hpp"

namespace couloir {
namespace {

void require_cell(const Grid& g, int i, int j) {
  if (i >= 0 && j >= 0 && i < g.nx && j < g.ny) return;
  std::ostringstream text;
  text << "There is no cell (" << i << ", " << j << ") in a grid of " << g.nx << " x " << g.ny << " cells.";
  throw std::out_of_range(text.str());
}

}  // namespace

Solver::Solver(const SolverSettings& settings, const ReferenceSurface& surface, const StepBed& bed)
    : impl_(std::make_unique<Impl>(settings, surface, bed)) {}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;

const Grid& Solver::grid() const {
  return impl_->settings.grid;
}
double Solver::time() const {
  return impl_->time;
}
std::int64_t Solver::steps() const {
  return impl_->steps;
}
std::int64_t Solver::cell_updates() const {
  return impl_->cell_updates;
}

PartTimes Solver::part_times() const {
  const auto laps = impl_->laps();
  return impl_->timer.times({laps.begin(), laps.end()});
}

void Solver::set(const std::function<FlowState(double x, double y)>& state) {
  Impl& m = *impl_;
  const auto set_all = [&] {
    for (BlockState& s : m.states) s.wet = 0;
    m.for_cells([&](int k, int c) {
      const Block& b = m.mesh.blocks()[k];
      const auto [i, j] = b.local(c);
      m.put_in(k, c, state(b.grid.x(b.i0 + i), b.grid.y(b.j0 + j)));
      if (with_earth_pressure(m.parameters)) m.states[k].passive_x[c] = m.states[k].passive_y[c] = 0;
    });
  };
  set_all();
  // Finer blocks may ask for still finer ones.
  for (int level = 0; level < m.settings.refinement.adaptive.levels && m.adapt(); ++level) set_all();
}

void Solver::fill_to(double surface) {
  Impl& m = *impl_;
  m.for_cells([&](int k, int c) { m.put_in(k, c, {std::max(0.0, surface - m.mesh.blocks()[k].bed[c]), 0, 0}); });
}

void Solver::set(int i, int j, const FlowState& q) {
  require_cell(grid(), i, j);
  impl_->put(i, j, q);
  impl_->set_active(i, j);
}

void Solver::add(int i, int j, const FlowState& more) {
  require_cell(grid(), i, j);
  if (impl_->zones.contains(i, j)) {
    std::ostringstream text;
    text << "Cell (" << i << ", " << j << ") is covered, so what falls into it is not the solver's; let it fall beside the zone.";
    throw std::out_of_range(text.str());
  }
  impl_->add(i, j, more);
}

FlowState Solver::at(int i, int j) const {
  impl_->sync();
  require_cell(grid(), i, j);
  return impl_->get(i, j);
}

FlowState Solver::at_side(int i, int j, SideName side) const {
  impl_->sync();
  require_cell(grid(), i, j);
  FlowState sum;
  const std::vector<FlowState> states = impl_->along(side, i, j);
  for (const FlowState& q : states) sum.h += q.h, sum.hu += q.hu, sum.hv += q.hv;
  const auto n = static_cast<double>(states.size());
  return {sum.h / n, sum.hu / n, sum.hv / n};
}

void Solver::gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const {
  impl_->sync();
  const Grid& g = grid();
  const std::size_t n = static_cast<std::size_t>(g.nx) * g.ny;
  h.resize(n), hu.resize(n), hv.resize(n);
  const bool uniform = impl_->settings.refinement.empty();
  for (std::size_t k = 0; uniform && k < impl_->states.size(); ++k) {
    const Block& b = impl_->mesh.blocks()[k];
    const Fields& q = impl_->states[k].now;
    for (int j = 0; j < b.ny; ++j) {
      const std::size_t to = static_cast<std::size_t>(b.j0 + j) * g.nx + b.i0;
      std::copy_n(&q.h[b.at(0, j)], b.nx, &h[to]);
      std::copy_n(&q.hu[b.at(0, j)], b.nx, &hu[to]);
      std::copy_n(&q.hv[b.at(0, j)], b.nx, &hv[to]);
    }
  }
  for (int j = 0; !uniform && j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const std::size_t to = static_cast<std::size_t>(j) * g.nx + i;
      const FlowState q = impl_->get(i, j);
      h[to] = q.h, hu[to] = q.hu, hv[to] = q.hv;
    }
  }
}

std::vector<BlockPlace> Solver::blocks() const {
  std::vector<BlockPlace> all;
  if (impl_->settings.refinement.empty()) return all;
  for (const Block& b : impl_->mesh.blocks()) all.push_back({b.level, b.i0, b.j0, b.nx, b.ny});
  return all;
}

void Solver::gather_block(int block, std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const {
  impl_->sync();
  const Block& b = impl_->mesh.blocks().at(block);
  const Fields& q = impl_->states[block].now;
  h.clear(), hu.clear(), hv.clear();
  for (int j = 0; j < b.ny; ++j) {
    for (int c = b.at(0, j); c < b.at(b.nx, j); ++c) h.push_back(q.h[c]), hu.push_back(q.hu[c]), hv.push_back(q.hv[c]);
  }
}

double Solver::volume() const {
  impl_->sync();
  double sum = 0;
  for (std::size_t k = 0; k < impl_->states.size(); ++k) sum += impl_->open_sum(static_cast<int>(k), impl_->states[k].now.h);
  return sum;
}

std::array<double, 2> Solver::momentum() const {
  impl_->sync();
  return impl_->momentum();
}

double Solver::min_depth() const {
  return impl_->min_depth;
}

double Solver::max_speed() const {
  impl_->sync();
  double fastest = 0;  // squared
  for (std::size_t k = 0; k < impl_->states.size(); ++k) {
    const Block& b = impl_->mesh.blocks()[k];
    const BlockState& s = impl_->states[k];
    for (int j = 0; s.wet && j < b.ny; ++j) {
      for (int c = b.at(0, j); c < b.at(b.nx, j); ++c) {
        const bool counts = s.open[c] != 0 && s.now.h[c] >= impl_->settings.dry_depth;
        const double u = counts ? s.now.hu[c] / s.now.h[c] : 0.0, v = counts ? s.now.hv[c] / s.now.h[c] : 0.0;
        fastest = std::max(fastest, u * u + v * v);
      }
    }
  }
  return std::sqrt(fastest);
}

std::array<double, 2> Solver::earth_pressure(int i, int j) const {
  impl_->sync();
  require_cell(grid(), i, j);
  if (!with_earth_pressure(impl_->parameters)) return {1, 1};
  impl_->refresh();
  const EarthPressure& k = impl_->settings.closure.earth_pressure;
  const auto [x, y] = impl_->passive(i, j);
  return {k.kx_mobilised(x), k.ky_mobilised(x, y)};
}

double Solver::stable_dt() const {
  return impl_->stable_dt();
}

void Solver::step(double dt) {
  impl_->step(dt);
}

void Solver::set_time(double t) {
  impl_->time = t;
}

void Solver::fail_step(double dt) const {
  impl_->fail_step(dt);
}

int Solver::cover(const CellBox& box) {
  const int id = impl_->zones.cover(box);
  impl_->lay_zones();
  return id;
}
void Solver::move_zone(int zone, const CellBox& box) {
  impl_->zones.move(zone, box);
  impl_->lay_zones();
}
void Solver::uncover(int zone) {
  impl_->zones.uncover(zone);
  impl_->lay_zones();
}
const CellBox& Solver::covered(int zone) const {
  return impl_->zones.zone(zone).box();
}
int Solver::zones() const {
  return impl_->zones.ids();
}

void Solver::set_covered(int i, int j, const FlowState& q) {
  if (!impl_->zones.contains(i, j)) {
    std::ostringstream text;
    text << "Cell (" << i << ", " << j << ") is not covered, so its state is the solver's own; use set().";
    throw std::out_of_range(text.str());
  }
  impl_->put(i, j, q);
}

void Solver::impose(int zone, SideName side, int k, const FaceFlux& flux) {
  impl_->zones.zone(zone).impose(side, k, flux);
}
FaceFlux Solver::passed(int zone, SideName side, int k) const {
  return impl_->zones.zone(zone).passed(side, k);
}
void Solver::reset_rim(int zone) {
  impl_->zones.zone(zone).reset_passed();
}

std::array<double, 2> Solver::obstacle_impulse(int id) const {
  return impl_->impulse.at(id);
}

int Solver::add_gauge(int i, int j0, int j1) {
  const Grid& g = grid();
  if (i < 0 || i > g.nx || j0 < 0 || j1 > g.ny || j0 >= j1) {
    throw std::out_of_range("A gauge needs an x-face and rows inside the grid; move it.");
  }
  impl_->gauges.push_back({i, j0, j1, 0.0});
  const int id = static_cast<int>(impl_->gauges.size()) - 1;
  impl_->lay_gauge(id);
  return id;
}

int Solver::add_control_box(const CellBox& box) {
  const Grid& g = grid();
  if (box.empty() || box.i0 < 0 || box.j0 < 0 || box.i1 > g.nx || box.j1 > g.ny) {
    throw std::out_of_range("A control box needs cells, and all of them inside the grid; move it.");
  }
  impl_->boxes.push_back({box, impl_->momentum_in(box), {}});
  const int id = static_cast<int>(impl_->boxes.size()) - 1;
  impl_->lay_box(id);
  return id;
}

std::array<double, 2> Solver::control_box_impulse(int id) const {
  impl_->sync();
  const Impl::ControlBox& box = impl_->boxes.at(id);
  const auto now = impl_->momentum_in(box.cells);
  std::array<double, 2> out;
  for (int k : {0, 1}) {
    out[k] = box.terms.faces[k] + (k == 0 ? box.terms.weight : 0.0) + box.terms.friction[k] - (now[k] - box.before[k]);
  }
  return out;
}

double Solver::gauge(int id) const {
  return impl_->gauges.at(id).volume;
}

const Budget& Solver::budget() const {
  return impl_->budget;
}
void Solver::reset_budget() {
  impl_->budget = {};
}

}  // namespace couloir
