#pragma once
// Coupling time, counted in integers: a window is a whole number of steps, seconds are derived.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace couloir {

class Clock {
 public:
  // Of an engine: steps of `step` [s], `per_window` to a window; the last window is shorter and ends with the step that reaches
  // `duration` [s].
  Clock(double step, std::int64_t per_window, double duration)
      : step_(step), per_window_(per_window), steps_(std::int64_t(std::ceil(duration / step - 1e-9))) {
    end_ = step * double(steps_);
  }

  // Without an engine: windows of `interval` [s], the last one ends at `duration`.
  static Clock of_intervals(double interval, double duration) {
    Clock clock(interval, 1, duration);
    clock.end_ = duration;
    return clock;
  }

  std::int64_t windows() const { return (steps_ + per_window_ - 1) / per_window_; }
  // Windows count from 1; 0 is the start.
  std::int64_t steps(std::int64_t window) const { return std::min(per_window_ * window, steps_) - per_window_ * (window - 1); }
  double time(std::int64_t window) const {  // [s] at its end
    return window < windows() ? step_ * double(per_window_ * window) : end_;
  }
  double length(std::int64_t window) const {  // [s]
    return window < windows() ? step_ * double(per_window_) : end_ - step_ * double(per_window_ * (window - 1));
  }

 private:
  double step_;
  std::int64_t per_window_, steps_;
  double end_;
};

// Due whenever `interval` more seconds have passed; counted in integers, so that it does not drift.
class Schedule {
 public:
  explicit Schedule(double interval) : interval_(interval) {}
  bool due(double time) {
    if (time < double(next_) * interval_ - 1e-9 * interval_) return false;
    next_ = std::int64_t(std::floor(time / interval_ + 1e-9)) + 1;
    return true;
  }

 private:
  double interval_;
  std::int64_t next_ = 0;
};

}  // namespace couloir
