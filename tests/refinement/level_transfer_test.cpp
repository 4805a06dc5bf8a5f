#include "continuum/mesh/level_transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace couloir::test {
namespace {

constexpr double quarter_x[] = {-0.25, 0.25, -0.25, 0.25}, quarter_y[] = {-0.25, -0.25, 0.25, 0.25}, dry = 1e-7;

// 3 x 3 cells of size 1 about the origin, their fields given by place.
struct Patch {
  Block block;
  Fields q;
  template <class H, class U, class V, class Z>
  Patch(H&& h, U&& hu, V&& hv, Z&& bed) {
    block.nx = block.ny = 3;
    block.relief = true;
    block.bed.assign(block.size(), 0.0);
    q.resize(block.size());
    for (int j = -2; j < 5; ++j) {
      for (int i = -2; i < 5; ++i) {
        const double x = i - 1, y = j - 1;
        const int c = block.at(i, j);
        q.h[c] = h(x, y), q.hu[c] = hu(x, y), q.hv[c] = hv(x, y), block.bed[c] = bed(x, y);
      }
    }
  }
  int middle() const { return block.at(1, 1); }
  std::array<FlowState, 4> children(const std::array<double, 4>& bed) const {
    const int c = middle();
    return children_of({q.h[c], q.hu[c], q.hv[c]}, block.bed[c], slopes_of(q, block, c, dry), bed);
  }
};

double none(double, double) {
  return 0;
}

TEST(LevelTransfer, LinearFieldsAreExact) {
  const auto h = [](double x, double y) { return 2 + 0.3 * x - 0.2 * y; };
  const auto hu = [](double x, double y) { return 1 + 0.1 * x + 0.4 * y; };
  const auto hv = [](double x, double y) { return -3 + 0.2 * x - 0.1 * y; };
  const auto bed = [](double x, double y) { return 0.5 * x + 0.25 * y; };
  const Patch p(h, hu, hv, bed);
  std::array<double, 4> beds;
  for (int k = 0; k < 4; ++k) beds[k] = bed(quarter_x[k], quarter_y[k]);
  const auto found = p.children(beds);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(found[k].h, h(quarter_x[k], quarter_y[k]), 1e-15);
    EXPECT_NEAR(found[k].hu, hu(quarter_x[k], quarter_y[k]), 1e-15);
    EXPECT_NEAR(found[k].hv, hv(quarter_x[k], quarter_y[k]), 1e-15);
  }
  const auto [x, y] = bed_slopes_of(p.block, p.middle());
  EXPECT_DOUBLE_EQ(x, 0.5 / 4);
  EXPECT_DOUBLE_EQ(y, 0.25 / 4);
}

TEST(LevelTransfer, ALakeStaysLevelOverAnyBed) {
  const auto bed = [](double x, double y) { return 0.2 * std::sin(3 * x) + 0.1 * x * y; };
  const Patch p([&](double x, double y) { return 1.5 - bed(x, y); }, none, none, bed);
  const std::array<double, 4> beds = {0.05, -0.1, 0.15, -0.1};  // about the middle's, 0
  const auto found = p.children(beds);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(found[k].h + beds[k], 1.5, 1e-15);
}

TEST(LevelTransfer, KeepsVolumeAndMomentumAndMakesNothingFaster) {
  unsigned seed = 7;
  const auto random = [&](double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (seed >> 8) / 16777216.0;
  };
  for (int n = 0; n < 2000; ++n) {
    const bool film = n % 3 == 0;
    const Patch p([&](double, double) { return film && random(0, 1) < 0.4 ? 0.0 : random(0, 2); },
                  [&](double, double) { return random(-3, 3); }, [&](double, double) { return random(-3, 3); },
                  [&](double, double) { return random(-0.5, 0.5); });
    Patch dried = p;
    double fastest = 0;
    for (int c = 0; c < p.block.size(); ++c) {
      if (p.q.h[c] < dry) dried.q.hu[c] = dried.q.hv[c] = 0;
    }
    const int m = p.middle(), row = p.block.row();
    for (int c : {m, m - 1, m + 1, m - row, m + row}) {
      if (dried.q.h[c] >= dry) fastest = std::max(fastest, std::abs(dried.q.hu[c] / dried.q.h[c]));
    }
    const double z = dried.block.bed[m], a = random(-0.3, 0.3), b = random(-0.3, 0.3);
    const auto found = dried.children({z - a - b, z + a - b, z - a + b, z + a + b});
    FlowState sum;
    for (const FlowState& q : found) {
      EXPECT_GE(q.h, 0);
      EXPECT_LE(std::abs(q.hu), fastest * q.h * (1 + 1e-8) + 1e-15);
      sum.h += q.h, sum.hu += q.hu, sum.hv += q.hv;
    }
    EXPECT_NEAR(sum.h, 4 * dried.q.h[m], 1e-14);
    EXPECT_NEAR(sum.hu, 4 * dried.q.hu[m], 2e-14);
    EXPECT_NEAR(sum.hv, 4 * dried.q.hv[m], 2e-14);
  }
}

TEST(LevelTransfer, TheMeanOfFourEqualsHasTheirBits) {
  const double same = 0.1234567890123;
  const std::vector<double> q(16, same);
  EXPECT_EQ(mean_of_children(q.data(), 0, 4), same);
}

}  // namespace
}  // namespace couloir::test
