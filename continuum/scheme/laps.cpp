#include "continuum/scheme/laps.hpp"

#include <algorithm>

namespace couloir {
namespace {

// [s] the least that was met between two laps with nothing between them.
double cost_of_lap() {
  static const double least = [] {
    Laps laps;
    laps.start(true);
    double found = 1;
    for (int k = 0; k < 1000; ++k) found = std::min(found, laps.since());
    return found;
  }();
  return least;
}

}  // namespace

const char* to_string(StepPart part) {
  constexpr std::array<const char*, part_count> names{
      "mesh",           "levels", "order",     "ghosts", "velocities", "rates",     "earth_pressure", "rest",   "shocks",
      "reconstruction", "bed",    "bed_steps", "fluxes", "sides",      "zone_rims", "measures",       "update", "planes"};
  return names[static_cast<std::size_t>(part)];
}

PartTimes Laps::times() const {
  PartTimes all{};
  for (int p = 0; p < part_count; ++p) all[p] = std::max(0.0, times_[p] - cost_of_lap() * static_cast<double>(counts_[p]));
  return all;
}

StepTimer::Span::Span(StepTimer& timer, std::int64_t step, std::vector<Laps*> each)
    : timer_(timer), outermost_(!timer.within_), each_(std::move(each)) {
  if (!outermost_) return;
  timer_.within_ = true;
  if (!timer_.first_) timer_.first_ = step;
  const bool on = (step - *timer_.first_) % every == 0;
  for (Laps* laps : each_) laps->start(on);
  timer_.set_apart_ = 0;
  start_ = Laps::Clock::now();
  timer_.laps_.start(on);
}

StepTimer::Span::~Span() {
  if (!outermost_) return;
  timer_.laps_.lap(StepPart::order);
  timer_.total_ += std::chrono::duration<double>(Laps::Clock::now() - start_).count() - timer_.set_apart_;
  timer_.within_ = false;
}

PartTimes StepTimer::times(const std::vector<const Laps*>& kernels) const {
  PartTimes all = laps_.times(), within{};
  for (const Laps* laps : kernels) add(within, laps->times());
  if (const double seen = sum(within); seen > 0)
    for (int p = 0; p < part_count; ++p) all[p] += kernels_ * within[p] / seen;
  const double timed = sum(all);
  for (int p = 0; p < part_count; ++p) all[p] = (timed > 0 ? all[p] * total_ / timed : 0) + apart_[p];
  return all;
}

}  // namespace couloir
