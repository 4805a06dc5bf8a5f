#include "coupling/records/coupling_noise.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace couloir {
namespace {

constexpr int least_segments = 4;

int reach(int windows) {
  return std::max(5, windows / 8 + 2);
}

std::size_t segments_in(std::size_t count, std::size_t length) {
  return count < length ? 0 : 1 + (count - length) / (length / 2);
}

// Welch's density at single bins; a transform of all of them would be mostly thrown away.
class Density {
 public:
  Density(const std::vector<double>& force, std::size_t length, double interval)
      : force_(force), length_(length), segments_(segments_in(force.size(), length)) {
    double power = 0;
    for (std::size_t n = 0; n < length; ++n) {
      const double angle = 2 * std::numbers::pi * double(n) / double(length);
      turn_.push_back(std::polar(1.0, -angle));
      weight_.push_back(0.5 - 0.5 * std::cos(angle));
      power += weight_.back() * weight_.back();
    }
    for (std::size_t s = 0; s < segments_; ++s) {
      double sum = 0;
      for (std::size_t n = 0; n < length; ++n) sum += force[s * length / 2 + n];
      mean_.push_back(sum / double(length));
    }
    scale_ = 2 * interval / (power * double(segments_));  // one-sided
  }

  double at(std::size_t bin) const {
    double sum = 0;
    for (std::size_t s = 0; s < segments_; ++s) {
      std::complex<double> amplitude = 0;
      for (std::size_t n = 0; n < length_; ++n)
        amplitude += weight_[n] * (force_[s * length_ / 2 + n] - mean_[s]) * turn_[bin * n % length_];
      sum += std::norm(amplitude);
    }
    return sum * scale_;
  }
  double mean(int from, int to) const {  // both included
    double sum = 0;
    for (int bin = from; bin <= to; ++bin) sum += at(std::size_t(bin));
    return sum / (to - from + 1);
  }

 private:
  const std::vector<double>& force_;
  std::size_t length_, segments_;
  double scale_ = 0;
  std::vector<std::complex<double>> turn_;
  std::vector<double> weight_, mean_;
};

struct Band {
  double own = 0, beside = 0;
};

Band band_at(const Density& s, int bin, int reach) {
  return {s.mean(bin - 1, bin + 1), std::sqrt(s.mean(bin - reach, bin - 3) * s.mean(bin + 3, bin + reach))};
}

double ratio(const Band& b) {
  return b.beside > 0 ? b.own / b.beside : 1;
}

}  // namespace

std::optional<CouplingNoise> coupling_noise(const std::vector<double>& force, int per_window, double interval) {
  int windows = 128;
  while (windows >= 16 && segments_in(force.size(), std::size_t(windows) * per_window) < least_segments) windows /= 2;
  if (windows < 16 || per_window < 1) return {};
  const Density density(force, std::size_t(windows) * per_window, interval);
  const int half = windows * per_window / 2, wide = reach(windows);
  CouplingNoise out;
  out.window_frequency = 1 / (per_window * interval);
  out.resolution = out.window_frequency / windows;
  out.segments = int(segments_in(force.size(), std::size_t(windows) * per_window));
  Band all, all_between;
  double excess = 0;
  for (int m = 1; m * windows + wide < half; ++m) {
    const Band band = band_at(density, m * windows, wide);
    NoiseHarmonic h{m * out.window_frequency, ratio(band), 1};
    all.own += band.own, all.beside += band.beside;
    excess += 3 * out.resolution * (band.own - band.beside);
    if (const int bin = m * windows + windows / 2; bin + wide < half) {
      const Band between = band_at(density, bin, wide);
      h.between = ratio(between);
      all_between.own += between.own, all_between.beside += between.beside;
    }
    out.harmonics.push_back(h);
  }
  if (out.harmonics.empty()) return {};
  out.over_neighbours = ratio(all);
  out.between = ratio(all_between);
  out.rms = std::sqrt(std::max(0.0, excess));
  return out;
}

}  // namespace couloir
