#pragma once
// How long the parts of a step take, by the solver's own clock. One step in seven is timed part by part, all of them as a whole;
// what the parts of the others took is taken in proportion. A lap costs some 30 ns, so that is not seen in a run's time
// (docs/results/effects.md has the figure).

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "continuum/scheme/step_parts.hpp"

namespace couloir {

// The time since the last lap goes to the part that the next one names.
class Laps {
 public:
  using Clock = std::chrono::steady_clock;
  void start(bool on) {
    on_ = on;
    start();
  }
  void start() {
    if (on_) last_ = Clock::now();
  }
  void lap(StepPart part) {
    if (!on_) return;
    const double took = since();
    double& sum = times_[static_cast<std::size_t>(part)];
    std::int64_t& count = counts_[static_cast<std::size_t>(part)];
    // Another program had the core meanwhile.
    if (took > interruption && count > 10 && took * static_cast<double>(count) > 10 * sum) return;
    sum += took;
    ++count;
  }
  double since() {  // [s] the last lap; starts anew
    const Clock::time_point now = Clock::now();
    const double took = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return took;
  }
  bool on() const { return on_; }
  PartTimes times() const;  // [s] without what the laps themselves took

 private:
  static constexpr double interruption = 2e-4;  // [s] no shorter one is taken for one
  bool on_ = false;
  Clock::time_point last_{};
  PartTimes times_{};
  std::array<std::int64_t, part_count> counts_{};
};

// Of a solver: its main thread's laps, and how those of the threads' kernels share what the main thread saw them take.
class StepTimer {
 public:
  // Times until it ends; one within another counts with that. `each`: every thread's laps, switched on and off with the step.
  class Span {
   public:
    Span(StepTimer& timer, std::int64_t step, std::vector<Laps*> each = {});
    ~Span();
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    StepTimer& timer_;
    bool outermost_;
    std::vector<Laps*> each_;
    Laps::Clock::time_point start_;
  };

  void lap(StepPart part) { laps_.lap(part); }
  void lap_kernels() {  // the time since the last lap went by in the threads' kernels
    if (laps_.on()) kernels_ += laps_.since();
  }
  // Timed in every step: what comes in some steps only.
  template <class F>
  void apart(StepPart part, F&& f) {
    const Laps::Clock::time_point start = Laps::Clock::now();
    f();
    const double took = std::chrono::duration<double>(Laps::Clock::now() - start).count();
    at(apart_, part) += took;
    set_apart_ += took;
    laps_.start();
  }
  PartTimes times(const std::vector<const Laps*>& kernels = {}) const;  // [s] so far

 private:
  static constexpr std::int64_t every = 7;  // no divisor of the steps between two looks at the mesh
  bool within_ = false;
  std::optional<std::int64_t> first_;
  double total_ = 0, set_apart_ = 0, kernels_ = 0;  // [s] total: without what is apart; kernels: in the timed steps
  PartTimes apart_{};
  Laps laps_;
};

}  // namespace couloir
