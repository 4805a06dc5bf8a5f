// What must not matter to the force on a wall: size and place of the zone, length of the windows, ranks of the engine, left and
// right. Each is compared over the same packings, since one run is one realisation: in a flow of grains other last bits lead to
// other contacts, and a changed zone cuts other grains.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

#include "coupling/records/force_series.hpp"
#include "tests/loop/small_run.hpp"

namespace couloir {
namespace {

constexpr int packings = 12;

struct Wall {
  double impulse = 0, peak = 0;  // [N s], [N] of a 15 ms mean
};

Wall force_on_the_wall(const Overrides& change, int packing) {
  Overrides all{{"grains.seed", std::to_string(20011 + packing)}};
  all.insert(all.end(), change.begin(), change.end());
  const Scene scene = read_scene(COULOIR_SOURCE_DIR "/experiments/coupling_invariance/scene.yaml",
                                 COULOIR_SOURCE_DIR "/dem_inputs/materials", all);
  ForceSeries series;
  const Watched run = watch(scene, options_in(fresh_folder("invariance")));
  for (const WindowReport& w : run.windows) {
    const double f = w.obstacles[0].force[0];
    series.add(w.time, w.length, f, f != 0);
  }
  EXPECT_EQ(run.end.status, "done");
  return {series.figures().impulse, series.figures().peak};
}

struct Figures {
  std::string name;
  std::vector<double> impulse, peak;
};

Figures figures(const std::string& name, const Overrides& change) {
  Figures out{name, {}, {}};
  for (int k = 0; k < packings; ++k) {
    const Wall wall = force_on_the_wall(change, k);
    out.impulse.push_back(wall.impulse), out.peak.push_back(wall.peak);
  }
  return out;
}

double mean(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / double(v.size());
}

double squares(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += (x - mean(v)) * (x - mean(v));
  return sum;
}

// The wall, the release and the zone down the slope by `by` [mm]; the cells stay.
Overrides moved(double by) {
  return {{"release.position", fmt::format("[{} mm, 0]", 40 + by)},
          {"obstacles.wall.position", fmt::format("[{} mm, 20 mm]", 560 + by)},
          {"grains.zone", fmt::format("{{x: [{} mm, {} mm], y: [-140 mm, 180 mm]}}", 320 + by, 640 + by)}};
}

using Pick = std::vector<double> Figures::*;

// Standard deviation from packing to packing, of all groups together.
double scatter(const std::vector<Figures>& groups, Pick pick) {
  double sum = 0;
  for (const Figures& g : groups) sum += squares(g.*pick);
  return std::sqrt(sum / double(groups.size() * (packings - 1)));
}

// No change may move the mean by more than one packing differs from the next. Means of twelve differ by chance alone with a
// standard deviation of sqrt(2 / 12) = 0.41 scatters: one scatter is 2.4 of them.
constexpr double most_shift = 1;

TEST(Invariance, OfTheForceOnAWall) {
  if (!std::getenv("COULOIR_LONG_TESTS")) GTEST_SKIP() << "120 runs, ten minutes: set COULOIR_LONG_TESTS=1";
  std::vector<Figures> all{
      figures("base", {}),
      figures("longer zone", {{"grains.zone", "{x: [260 mm, 720 mm], y: [-140 mm, 180 mm]}"}}),
      figures("wider zone", {{"grains.zone", "{x: [320 mm, 640 mm], y: [-200 mm, 200 mm]}"}}),
      figures("moved by a quarter of a cell", moved(5)),
      figures("moved by half a cell", moved(10)),
      figures("windows half as long", {{"grains.window", "20"}}),
      figures("windows as long as may be", {{"grains.window", "56"}}),
      figures("two ranks", {{"grains.ranks", "2"}}),
      figures("mirrored",
              {{"obstacles.wall.position", "[560 mm, -20 mm]"}, {"grains.zone", "{x: [320 mm, 640 mm], y: [-180 mm, 140 mm]}"}}),
  };
  for (const Figures& g : all) {
    std::string line = fmt::format("{:30} impulse {:.4f}, peak {:.2f}:", g.name, mean(g.impulse), mean(g.peak));
    for (int k = 0; k < packings; ++k) line += fmt::format("  {:.4f} {:.2f}", g.impulse[k], g.peak[k]);
    std::printf("%s\n", line.c_str());
  }
  const Figures faster = figures("a release 30 % faster", {{"release.velocity", "1.3 m/s"}});
  for (const auto& [word, pick] : {std::pair<std::string, Pick>{"impulse", &Figures::impulse}, {"peak", &Figures::peak}}) {
    const double one = scatter(all, pick), base = mean(all[0].*pick);
    ASSERT_GT(one, 0) << word << ": the packings do not differ";
    for (const Figures& g : all)
      EXPECT_LT(std::abs(mean(g.*pick) - base), most_shift * one)
          << word << ", " << g.name << ": " << mean(g.*pick) << " for " << base;
    EXPECT_GT(mean(faster.*pick) - base, most_shift * one) << word << ": what does change the force must be seen";
  }
}

}  // namespace
}  // namespace couloir
