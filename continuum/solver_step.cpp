// A step: the coarsest cells take one, the next ones two, and so on. Finer cells go first, between what the coarser ones hold now
// and what they will about hold, one stage ahead; then the coarser ones take what has passed their common faces.

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "continuum/errors.hpp"
#include "continuum/scheme/effects.hpp"
#include "continuum/solver_impl.hpp"

namespace couloir {
namespace {

constexpr int most_halvings = 30;  // of a step that would overdraw a cell; a short enough step never does
constexpr int steps_between_deals = 64;

}  // namespace

void Solver::Impl::step(double dt) {
  if (!(dt > 0)) throw std::invalid_argument("A step of the continuum needs a positive length in time.");
  const StepTimer::Span span(timer, steps, laps());
  if (settings.refinement.adaptive.levels > 0 && steps % settings.refinement.adaptive.interval == 0)
    timer.apart(StepPart::mesh, [&] { adapt(); });
  if (!settings.ranks.alone() && steps % steps_between_deals == 0) timer.apart(StepPart::mesh, [&] { deal(); });
  dt = std::min(dt, stable_dt());
  const double row = next_row(settings.sides, time);
  double end = row - time <= dt ? row : time + dt;
  dt = std::min(dt, row - time);
  wet_before.clear();
  for (const BlockState& s : states) wet_before.push_back(s.wet);
  for (int halvings = 0;; ++halvings) {
    std::fill(touched.begin(), touched.end(), 0);
    zones.limit(dt, std::ldexp(0.5, -halvings), [&](SideName side, int i, int j) { return along(opposite(side), i, j); });
    if (advance(0, time, end, dt, 0)) break;
    if (halvings == most_halvings) share_tallies(), fail_negative(dt);
    go_back();
    dt *= 0.5;
    end = time + dt;
  }
  collect_tallies();
  count_zones(dt);
  time = end;
  ++steps;
  rate.reset();
}

// Positivity asks for rate * dt <= cfl <= 1/2. Slope and bed may speed up what is slow now: their part grows with dt.
double Solver::Impl::stable_dt() {
  refresh();
  const double r = *rate;
  if (!(r > 0) && steepest == 0) return std::numeric_limits<double>::max();
  return 2 * settings.cfl / (r + std::sqrt(r * r + 4 * steepest * settings.cfl));
}

void Solver::Impl::refresh() {
  if (rate) return;
  const StepTimer::Span span(timer, steps, laps());
  const std::vector<double> rates = begin(0, time, 0);
  double most = 0;
  for (std::size_t level = 0; level < rates.size(); ++level)
    most = std::max(most, std::ldexp(rates[level], -static_cast<int>(level)));
  rate = most;
}

std::vector<double> Solver::Impl::begin(int level, double at, double share) {
  const int finest = static_cast<int>(levels.size()) - 1;
  for (int l = finest; l >= level; --l) choose(l, false);
  set_inflow(at);
  std::vector<double> rates(states.size(), 0.0), most;
  for (int l = level; l <= finest; ++l) {
    const std::vector<int>& own = levels[l].own;
    const int n = static_cast<int>(own.size());
    for (int b : levels[l].blocks) states[b].looked = states[b].looked && l == level;
    fill_ghosts(l, l > level ? 0 : share, true);
    timer.lap(StepPart::order);
#pragma omp parallel for num_threads(settings.threads) schedule(dynamic)
    for (int k = 0; k < n; ++k) {
      const int b = own[k];
      rates[b] = kernels.begin_step(parameters, mesh.blocks()[b], faces[b], states[b], scratch[omp_get_thread_num()],
                                    levels[l].strained);
    }
    timer.lap_kernels();
    levels[l].strained = 0;
    if (with_earth_pressure(parameters)) halo.tell_passive(l, states);
    most.push_back(0);
    for (int b : own) most.back() = std::max(most.back(), rates[b]);
  }
  // Once they have followed on all these levels.
  for (int l = level; with_earth_pressure(parameters) && l <= finest; ++l) {
    for (int b : levels[l].chosen) changed[b] = 1;
    const std::vector<int>& own = levels[l].own;
    const int n = static_cast<int>(own.size());
#pragma omp parallel for num_threads(settings.threads) schedule(static)
    for (int k = 0; k < n; ++k) ghosts->fill_passive(states, own[k]);
  }
  timer.lap(StepPart::earth_pressure);
  settings.ranks.greatest(most);
  if (std::ranges::any_of(most, [](double r) { return std::isinf(r); })) sync(), check_finite();
  return most;
}

bool Solver::Impl::advance(int level, double from, double to, double dt, double share) {
  if (share > 0) {
    // What has become faster since the whole step's start may still be slow enough for positivity.
    const double fastest = begin(level, from, share).front();
    if (fastest * dt > 0.5) return false;
  }
  if (level + 1 < static_cast<int>(levels.size())) {
    timer.lap(StepPart::order);
    look_ahead(level, from, to, dt);
    timer.lap(StepPart::levels);
    const double middle = from + 0.5 * dt;
    if (!advance(level + 1, from, middle, 0.5 * dt, 0)) return false;
    if (!advance(level + 1, middle, to, 0.5 * dt, 0.5)) return false;
    halo.tell_fluxes(level, across);
    timer.lap(StepPart::levels);
  }
  choose(level, false);
  look(level, levels[level].chosen);
  for (int k : levels[level].own) {
    if (!states[k].begun) fill_block(k, share, true);  // material has come near while the finer levels stepped
  }
  set_inflow(from, to);
  if (!run(level, StageName::predictor, dt)) return false;
  choose(level, true);
  set_inflow(to, Moment::before);
  fill_ghosts(level, share + 0.5, false);  // the shares of the passive state stay within a step
  levels[level].strained = dt;
  return run(level, StageName::corrector, dt);
}

// The predictor, for the sake of what it says of the cells beside finer ones.
void Solver::Impl::look_ahead(int level, double from, double to, double dt) {
  set_inflow(from, to);
  std::vector<int> beside;
  for (int k : levels[level].own) {
    if (beside_finer[k]) beside.push_back(k);
  }
  const int n = static_cast<int>(beside.size());
#pragma omp parallel num_threads(settings.threads)
  {
    Tally nobodys;
#pragma omp for schedule(dynamic)
    for (int m = 0; m < n; ++m) {
      const int k = beside[m];
      nobodys.reset(impulse.size(), gauges.size(), boxes.size());
      kernels.run_stage(parameters, mesh.blocks()[k], faces[k], zones, {}, states[k], scratch[omp_get_thread_num()],
                        StageName::predictor, dt, nobodys);
    }
  }
  for (int k : levels[level + 1].chosen) ghosts->look_ahead(states, k, settings.dry_depth, owned);
  halo.tell_looks(level + 1, *ghosts);
  for (int k : beside) {
    states[k].back_to_start(mesh.blocks()[k]);
    states[k].wet = states[k].was_wet;
  }
  for (int k : levels[level].blocks) std::fill(across[k].begin(), across[k].end(), LevelFlux{});
}

void Solver::Impl::choose(int level, bool corrector) {
  Level& l = levels[level];
  l.chosen.clear(), l.own.clear();
  for (int k : l.blocks) {
    BlockState& s = states[k];
    bool active = inflow_block[k] || !faces[k].rim.empty() || s.wet;
    for (const auto& [n, sides] : ghosts->neighbours(k)) {
      // A finer neighbour that steps has something to say about the face.
      active = active || (states[n].wet & sides) == sides || (mesh.blocks()[n].level > level && states[n].stepped);
    }
    if (!corrector) {
      s.begun = s.stepped;
      s.stepped = active;
      s.was_wet = s.wet;
    } else if (active && !s.stepped) {
      s.start = s.now;  // the predictor left it as it was
    }
    if (active || (corrector && s.stepped)) l.chosen.push_back(k);
  }
  std::ranges::copy_if(l.chosen, std::back_inserter(l.own), [&](int k) { return mine(k); });
}

void Solver::Impl::set_inflow(double at, Moment moment) {
  ghosts->set_time(at, moment);
  for (int side = 0; side < 4; ++side) parameters.inflow[side] = inflow_at(settings.sides[side], at, moment);
}

void Solver::Impl::set_inflow(double from, double to) {
  set_inflow(from);
  for (int side = 0; side < 4; ++side) parameters.discharge[side] = mean_discharge(settings.sides[side], from, to);
}

void Solver::Impl::fill_ghosts(int level, double share, bool shares) {
  timer.lap(StepPart::order);
  look(level, levels[level].chosen);
  timer.lap(StepPart::levels);
  const std::vector<int>& own = levels[level].own;
  const int n = static_cast<int>(own.size());
#pragma omp parallel for num_threads(settings.threads) schedule(static)
  for (int k = 0; k < n; ++k) fill_block(own[k], share, shares || !states[own[k]].stepped);
  timer.lap(StepPart::ghosts);
}

void Solver::Impl::fill_block(int k, double share, bool shares) {
  ghosts->fill(states, k, share);
  if (with_earth_pressure(parameters) && shares) ghosts->fill_passive(states, k);
}

// Each rank at its own coarser cells, for all who have finer ones beside them.
void Solver::Impl::look(int level, const std::vector<int>& blocks) {
  if (level == 0) return;
  bool any = false;
  for (int k : blocks) {
    if (states[k].looked) continue;
    ghosts->look(mesh, states, k, settings.dry_depth, owned);
    states[k].looked = any = true;
  }
  if (any) halo.tell_looks(level, *ghosts);
}

// The bound of stable_dt() is that of the step's start; a stage that speeds the flow up a lot may overdraw a cell.
bool Solver::Impl::run(int level, StageName stage, double dt) {
  constexpr char negative = wet_everywhere + 1;
  const Level& l = levels[level];
  for (int b : l.chosen) {
    if (!touched[b]) {
      tallies[b].reset(impulse.size(), gauges.size(), boxes.size());
      if (level > 0 && mine(b)) {
        before[b].q = states[b].now;
        before[b].passive_x = states[b].passive_x, before[b].passive_y = states[b].passive_y;
      }
    }
    touched[b] = changed[b] = 1;
  }
  const int n = static_cast<int>(l.own.size());
  timer.lap(StepPart::order);
#pragma omp parallel for num_threads(settings.threads) schedule(dynamic)
  for (int k = 0; k < n; ++k) {
    const int b = l.own[k];
    kernels.run_stage(parameters, mesh.blocks()[b], faces[b], zones, {&across[b], &across}, states[b],
                      scratch[omp_get_thread_num()], stage, dt, tallies[b]);
  }
  timer.lap_kernels();
  std::vector<char> flags;
  for (int b : l.chosen) flags.push_back(mine(b) ? states[b].wet | (tallies[b].min_depth < 0 ? negative : 0) : 0);
  settings.ranks.any(flags);
  bool good = true;
  for (std::size_t k = 0; k < flags.size(); ++k) {
    states[l.chosen[k]].wet = flags[k] & wet_everywhere;
    good = good && !(flags[k] & negative);
  }
  halo.tell_state(level, states);
  return good;
}

void Solver::Impl::go_back() {
  for (std::size_t k = 0; k < states.size(); ++k) {
    BlockState& s = states[k];
    s.wet = wet_before[k];
    if (!touched[k] || !mine(static_cast<int>(k))) continue;
    if (mesh.blocks()[k].level == 0) {
      s.back_to_start(mesh.blocks()[k]);
      continue;
    }
    std::swap(s.now, before[k].q);
    std::swap(s.passive_x, before[k].passive_x);
    std::swap(s.passive_y, before[k].passive_y);
  }
  for (std::size_t l = 0; l < levels.size(); ++l) {
    levels[l].strained = 0;
    halo.tell_state(static_cast<int>(l), states);
    if (with_earth_pressure(parameters)) halo.tell_passive(static_cast<int>(l), states);
  }
  begin(0, time, 0);
}

std::vector<Laps*> Solver::Impl::laps() {
  std::vector<Laps*> all;
  for (Scratch& s : scratch) all.push_back(&s.laps);
  return all;
}

void Solver::Impl::collect_tallies() {
  share_tallies();
  bool finite = true;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!touched[k]) continue;
    const Tally& t = tallies[k];
    budget.add(t.budget);
    for (std::size_t o = 0; o < impulse.size(); ++o) {
      for (int c : {0, 1}) impulse[o][c] += t.impulse[o][c];
    }
    for (std::size_t g = 0; g < gauges.size(); ++g) gauges[g].volume += t.gauge[g];
    for (std::size_t n = 0; n < boxes.size(); ++n) boxes[n].terms.add(t.boxes[n]);
    min_depth = min_depth_met ? std::min(min_depth, t.min_depth) : t.min_depth;
    min_depth_met = true;
    cell_updates += t.cell_updates;
    finite = finite && t.finite;
  }
  if (!finite) sync(), check_finite();
}

}  // namespace couloir
