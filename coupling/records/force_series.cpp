#include "coupling/records/force_series.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

void ForceSeries::add(double time, double length, double force, bool contact) {
  if (contact && contact_ < 0) contact_ = time - length;
  impulse_.push_back((impulse_.empty() ? 0.0 : impulse_.back()) + force * length);
  end_.push_back(time);
  begin_.push_back(time - length);
  force_.push_back(force);
}

double ForceSeries::impulse_at(double time) const {
  const auto after = std::lower_bound(end_.begin(), end_.end(), time);
  if (after == end_.end()) return impulse_.empty() ? 0 : impulse_.back();
  const auto k = std::size_t(after - end_.begin());
  return impulse_[k] - force_[k] * std::min(end_[k] - time, end_[k] - begin_[k]);
}

// Of the windows that some component touched, the first that is not a trace before the front.
double ForceSeries::contact(double largest) const {
  for (std::size_t k = 0; contact_ >= 0 && largest > 0 && k < end_.size(); ++k) {
    if (begin_[k] >= contact_ && std::abs(force_[k]) >= kContactShare * largest) return begin_[k];
  }
  return contact_;
}

ForceFigures ForceSeries::figures() const {
  ForceFigures out;
  if (end_.empty()) return out;
  for (double f : force_) {
    if (std::abs(f) > std::abs(out.peak_window)) out.peak_window = f;
  }
  out.first_contact = contact(std::abs(out.peak_window));
  const double begun = out.first_contact, last = end_.back();
  const double span = begun >= 0 ? std::min(kPeakSpan, last - begun) : kPeakSpan;
  const auto look = [&](double t) {
    const double mean = (impulse_at(t) - impulse_at(t - span)) / span;
    if (std::abs(mean) > std::abs(out.peak)) out.peak = mean, out.peak_time = t;
  };
  for (std::size_t k = 0; k < end_.size(); ++k) {
    look(end_[k]);
    if (end_[k] + span < last) look(end_[k] + span);
  }
  out.impulse = impulse_.back();
  out.mean_of_run = out.impulse / (last - begin_.front());
  if (begun >= 0 && last > begun) out.mean = (out.impulse - impulse_at(begun)) / (last - begun);
  const double tail = std::min(kFinalSpan, last - begin_.front());
  if (tail > 0) out.final = (out.impulse - impulse_at(last - tail)) / tail;
  return out;
}

}  // namespace couloir
