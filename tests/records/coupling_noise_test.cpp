// How far a force's spectrum stands out at the windows' frequency: series with known answers.
#include "coupling/records/coupling_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace couloir {
namespace {

constexpr int per_window = 8;
constexpr double interval = 1.25e-4;  // [s]: windows of 1 ms

std::vector<double> white(std::size_t count, unsigned seed, double sigma = 1) {
  std::mt19937_64 bits(seed);
  std::vector<double> out;
  for (std::size_t n = 0; n < count; ++n) {  // sum of twelve uniforms: the same numbers with every library
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += double(bits() >> 11) * 0x1p-53;
    out.push_back(sigma * sum);
  }
  return out;
}

void add_tone(std::vector<double>& force, double amplitude, double frequency) {
  for (std::size_t n = 0; n < force.size(); ++n)
    force[n] += amplitude * std::sin(2 * std::numbers::pi * frequency * interval * double(n) + 0.4);
}

TEST(CouplingNoise, OfWhiteNoiseIsOne) {
  double mean = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto noise = coupling_noise(white(8000, seed), per_window, interval);
    ASSERT_TRUE(noise);
    EXPECT_EQ(noise->harmonics.size(), 3u);
    EXPECT_NEAR(noise->window_frequency, 1000, 1e-9);
    EXPECT_NEAR(noise->resolution, 1000.0 / 128, 1e-9);
    EXPECT_EQ(noise->segments, 14);  // of 1024 samples, half overlapping
    mean += noise->over_neighbours / 20;
  }
  EXPECT_NEAR(mean, 1, 0.06);  // three bands of three bins over 14 segments: 0.2 for one series
}

// A tone of amplitude A has the power A^2/2, of which Welch's density S has all in three bins.
TEST(CouplingNoise, FindsATone) {
  for (const int harmonic : {1, 2, 3}) {
    std::vector<double> force = white(16000, 7);
    const double sigma = std::sqrt([&] {
      double sum = 0;
      for (const double f : force) sum += f * f;
      return sum / double(force.size());
    }());
    add_tone(force, 0.5, 1000.0 * harmonic);
    const auto noise = coupling_noise(force, per_window, interval);
    ASSERT_TRUE(noise);
    EXPECT_NEAR(noise->rms, 0.5 / std::sqrt(2), 0.06) << harmonic;
    const double floor = 2 * interval * sigma * sigma, band = 0.125 / (3 * noise->resolution) + floor;
    EXPECT_NEAR(noise->harmonics[std::size_t(harmonic - 1)].over_neighbours, band / floor, 0.25 * band / floor) << harmonic;
    for (std::size_t m = 0; m < 3; ++m)
      if (int(m) != harmonic - 1) EXPECT_NEAR(noise->harmonics[m].over_neighbours, 1, 0.6);
  }
}

TEST(CouplingNoise, LeavesToOthersWhatIsNotAtItsFrequencies) {
  std::vector<double> force = white(16000, 3);
  add_tone(force, 0.5, 1500);
  const auto noise = coupling_noise(force, per_window, interval);
  ASSERT_TRUE(noise);
  EXPECT_NEAR(noise->over_neighbours, 1, 0.5);
  EXPECT_GT(noise->harmonics[0].between, 10);
}

// Grains' forces fall as f^-2 and start with an impact: neither makes a peak.
TEST(CouplingNoise, IsNotLedAstrayByAFallingSpectrum) {
  double mean = 0, between = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<double> force = white(6000, 100 + seed);
    double walk = 0;
    for (std::size_t n = 0; n < force.size(); ++n) {
      walk = 0.995 * walk + force[n];
      force[n] = walk + 200 * std::exp(-double(n) * interval / 0.05);
    }
    const auto noise = coupling_noise(force, per_window, interval);
    ASSERT_TRUE(noise);
    mean += noise->over_neighbours / 20, between += noise->between / 20;
  }
  EXPECT_NEAR(mean, 1, 0.12);
  EXPECT_NEAR(between, 1, 0.12);
}

TEST(CouplingNoise, NeedsEnoughWindowsAndSamples) {
  EXPECT_FALSE(coupling_noise({}, per_window, interval));
  EXPECT_FALSE(coupling_noise(white(39 * 8, 1), per_window, interval));  // four segments of 16 windows need 40
  EXPECT_TRUE(coupling_noise(white(40 * 8, 1), per_window, interval));
  EXPECT_FALSE(coupling_noise(white(4000, 1), 1, 8 * interval));
  EXPECT_FALSE(coupling_noise(white(4000, 1), 2, 4 * interval));
  EXPECT_EQ(coupling_noise(white(4000, 1), 4, 2 * interval)->harmonics.size(), 1u);
}

}  // namespace
}  // namespace couloir
