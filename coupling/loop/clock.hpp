#pragma once
// Coupling time, counted in integers: a window is a whole number of engine steps, seconds are derived.

#include <cmath>
#include <cstdint>

namespace couloir {

class Clock {
 public:
  // step [s]; steps in a window; the run ends with the window that reaches duration [s].
  Clock(double step, std::int64_t steps_per_window, double duration)
      : step_(step),
        per_window_(steps_per_window),
        windows_(std::int64_t(std::ceil(duration / (step * double(steps_per_window)) - 1e-9))) {}

  std::int64_t windows() const { return windows_; }
  std::int64_t steps_per_window() const { return per_window_; }
  double step() const { return step_; }
  double window() const { return step_ * double(per_window_); }                            // [s]
  double time(std::int64_t window) const { return step_ * double(per_window_ * window); }  // [s] at the end of a window, 1-based

 private:
  double step_;
  std::int64_t per_window_, windows_;
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
