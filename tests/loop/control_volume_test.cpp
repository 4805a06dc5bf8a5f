// One force by two measures in each mode, with the real engine: what the obstacles feel, and what the material loses to them.

#include <cmath>
#include <numbers>

#include "small_run.hpp"

namespace couloir {
namespace {

struct Forces {
  double own = 0, by_control_volume = 0;           // [N s] impulses
  double peak = 0, largest = 0;                    // [N] of the own force and of the difference, means of 15 ms
  std::vector<double> difference, length, window;  // [N], [s], [N] own
};

// Means over 15 ms, of windows that are much shorter.
double largest_mean(const std::vector<double>& force, const std::vector<double>& length) {
  double most = 0;
  for (std::size_t end = 0; end < force.size(); ++end) {
    double sum = 0, span = 0;
    for (std::size_t k = end + 1; k-- > 0 && span < 0.015;) sum += force[k] * length[k], span += length[k];
    if (span >= 0.015) most = std::max(most, std::abs(sum / span));
  }
  return most;
}

Forces forces_of(const Watched& run) {
  Forces f;
  for (const WindowReport& w : run.windows) {
    f.own += w.force_together() * w.length;
    f.by_control_volume += w.force_by_control_volume() * w.length;
    f.difference.push_back(w.force_by_control_volume() - w.force_together());
    f.window.push_back(w.force_together());
    f.length.push_back(w.length);
    EXPECT_NEAR(w.force_together(), w.obstacles[0].force[0], 1e-9 * (1 + std::abs(w.obstacles[0].force[0]))) << w.time;
  }
  f.peak = largest_mean(f.window, f.length);
  f.largest = largest_mean(f.difference, f.length);
  std::printf("own impulse %.5g N s, by control volume %.5g N s; own peak %.4g N, largest difference %.3g N (15 ms)\n", f.own,
              f.by_control_volume, f.peak, f.largest);
  return f;
}

TEST(ControlVolume, OfTheContinuumIsItsOwnForceToRoundOff) {
  for (const char* scheme : {"central_upwind", "noc"}) {
    Overrides more{{"continuum.scheme", scheme}};
    if (scheme == std::string("noc")) more.push_back({"obstacles.wall.method", "elevation"});
    const Watched run = watch(small_scene("continuum", more), options_in(fresh_folder("continuum")));
    const Forces f = forces_of(run);
    EXPECT_GT(f.own, scheme == std::string("noc") ? 0.001 : 0.1) << scheme;  // noc lets the flow climb over cells this coarse
    for (const WindowReport& w : run.windows)
      ASSERT_LE(std::abs(w.force_by_control_volume() - w.force_together()) * w.length, 1e-11 * w.momentum.scale)
          << scheme << " at " << w.time;
  }
}

TEST(ControlVolume, OfGrainsIsTheSumOfContactsToRoundOff) {
  for (const char* engine : {"liggghts", "yade"}) {
    const Watched run =
        watch(small_scene("grains", {{"grains.engine", engine}, {"duration", "0.17 s"}}), options_in(fresh_folder(engine)));
    const Forces f = forces_of(run);
    EXPECT_GT(f.own, 0.01) << engine;
    for (const WindowReport& w : run.windows)
      ASSERT_LE(std::abs(w.force_by_control_volume() - w.force_together()) * w.length, 1e-9 * w.momentum.scale)
          << engine << " at " << w.time;
  }
}

// What the two sides of the zone's faces do not give each other is the difference.
TEST(ControlVolume, OfTheCoupledRunShowsWhatTheFacesLose) {
  const Watched run = watch(small_scene("coupled"), options_in(fresh_folder("coupled")));
  const Forces f = forces_of(run);
  EXPECT_GT(f.own, 0.01);
  for (const WindowReport& w : run.windows)
    ASSERT_NEAR((w.force_by_control_volume() - w.force_together()) * w.length, -w.momentum.residual, 1e-13 * w.momentum.scale);
  // Of the size of the flow's pressure on the face, 0.2 N, which rafts that move with the flow do not pass on.
  EXPECT_LT(f.largest, 0.1 * f.peak);
  EXPECT_NEAR(f.by_control_volume, f.own, 0.1 * f.own);
  EXPECT_GT(f.by_control_volume, f.own);
}

// In the window in which grains take the place of what flows in the zone: nothing jumps.
TEST(ControlVolume, KnowsThatTheZoneIsFilled) {
  const Watched run =
      watch(small_scene("coupled", {{"grains.zone", "{x: [100 mm, 440 mm], y: [-70 mm, 70 mm]}"}, {"duration", "0.06 s"}}),
            options_in(fresh_folder("filled")));
  ASSERT_EQ(run.events.size(), 1u);
  ASSERT_EQ(run.events[0].time, 0);
  const WindowReport& first = run.windows[0];
  ASSERT_GT(first.grains, 300);
  std::printf("first window: residual over the momentum %.3g\n", first.momentum.residual / first.momentum.scale);
  EXPECT_GT(first.momentum.scale, 0.5);
  EXPECT_LT(std::abs(first.momentum.residual), 0.005 * first.momentum.scale);
  EXPECT_GT(first.momentum.gravity, 0.9 * first.mass.initial * 9.81 * std::sin(35 * std::numbers::pi / 180) * first.length);
}

}  // namespace
}  // namespace couloir
