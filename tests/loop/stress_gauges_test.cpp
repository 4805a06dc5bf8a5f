// Stress gauges in whole runs, with both engines: their forces are parts of the wall's.

#include "coupling/loop/stress_gauges.hpp"

#include <cmath>

#include "small_run.hpp"

namespace couloir {
namespace {

struct Gauged : Watched {
  std::vector<StressGauge> list;
  void on_start(const RunStart& start) override { list = start.stress_gauges; }
};

Gauged watch_gauges(const Scene& scene) {
  Gauged watched;
  run_scene(scene, options_in(fresh_folder("stress")), {&watched});
  return watched;
}

Scene filled_box(const std::string& engine, Overrides more) {
  more.push_back({"grains.engine", engine});
  return read_scene(COULOIR_SOURCE_DIR "/tests/scenes/filled_box.yaml", COULOIR_SOURCE_DIR "/dem_inputs/materials", more);
}

double largest_residual(const Watched& run) {
  double worst = 0;
  for (const WindowReport& w : run.windows)
    if (w.momentum.scale > 0) worst = std::max(worst, std::abs(w.momentum.residual) / w.momentum.scale);
  return worst;
}

// Of the last 50 ms: normal force of each gauge, and the wall's along the slope [N].
struct Late {
  std::vector<double> gauges;
  double wall = 0;
};
Late late(const Gauged& run) {
  Late out{std::vector<double>(run.list.size()), 0};
  const double end = run.windows.back().time;
  double span = 0;
  for (const WindowReport& w : run.windows) {
    if (w.time < end - 0.05) continue;
    span += w.length;
    out.wall += w.obstacles[0].force[0] * w.length;
    for (std::size_t k = 0; k < run.list.size(); ++k) out.gauges[k] += w.stresses[k].normal * run.list[k].area * w.length;
  }
  out.wall /= span;
  for (double& force : out.gauges) force /= span;
  return out;
}

struct StressGauges : testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(On, StressGauges, testing::Values("liggghts", "yade"), [](const auto& info) { return info.param; });

// A heap in the middle of a wide front touches nothing else: on a gauge that is all of it the three stresses are the wall's
// force.
TEST_P(StressGauges, OverTheWholeFrontIsTheWall) {
  const Gauged all =
      watch_gauges(filled_box(GetParam(), {{"terrain.width", "144 mm"},
                                           {"obstacles.wall.size", "[12 mm, 144 mm, 60 mm]"},
                                           {"obstacles.wall.gauges", "{all: {centre: [0, 30 mm], size: [144 mm, 60 mm]}}"},
                                           {"duration", "0.15 s"}}));
  ASSERT_EQ(all.list.size(), 1u);
  EXPECT_EQ(all.list[0].area, 0.144 * 0.06);
  double largest = 0;
  for (const WindowReport& w : all.windows) {
    ASSERT_EQ(w.stresses.size(), 1u);
    const Vec& f = w.obstacles[0].force;
    const GaugeStress& s = w.stresses[0];
    const double a = all.list[0].area;
    ASSERT_NEAR(s.normal * a, f[0], 1e-12) << "at " << w.time;
    ASSERT_NEAR(s.across * a, f[1], 1e-12) << "at " << w.time;
    ASSERT_NEAR(s.up * a, f[2], 1e-12) << "at " << w.time;
    largest = std::max(largest, f[0]);
  }
  EXPECT_GT(largest, 0.3);
  EXPECT_LE(largest_residual(all), 1e-9);
}

// A heap at rest: three bands that tile the front carry the wall's force, those below the most; and the wall carries what it does
// without gauges, within what friction at rest allows.
TEST_P(StressGauges, BandsOfAHeapAtRestSumToTheForce) {
  const Gauged bands = watch_gauges(filled_box(
      GetParam(), {{"obstacles.wall.gauges",
                    "{low: {centre: [0, 6 mm], size: [48 mm, 12 mm]}, middle: {centre: [0, 18 mm], size: [48 mm, 12 mm]}, "
                    "high: {centre: [0, 42 mm], size: [48 mm, 36 mm]}}"}}));
  const Gauged plain = watch_gauges(filled_box(GetParam(), {}));
  EXPECT_TRUE(plain.list.empty());
  EXPECT_LE(largest_residual(bands), 1e-9);
  const Late with = late(bands), without = late(plain);
  ASSERT_EQ(with.gauges.size(), 3u);
  EXPECT_NEAR(with.gauges[0] + with.gauges[1] + with.gauges[2], with.wall, 1e-9);
  EXPECT_GT(with.gauges[0] + with.gauges[1], 2 * with.gauges[2]);
  EXPECT_GT(with.gauges[2], 0);
  EXPECT_NEAR(with.wall / without.wall, 1, 0.15);  // six packings: 1.01 +- 0.05
  const double weight = bands.windows.back().mass.grains * 9.81, angle = 35 * 3.14159265358979 / 180;
  EXPECT_LT(with.wall, weight * (std::sin(angle) + 0.4 * std::cos(angle)));
  EXPECT_GT(with.wall, weight * (std::sin(angle) - 0.4 * std::cos(angle)));
  std::printf("%s: wall %.3f N, without gauges %.3f N; bands %.3f, %.3f, %.3f N\n", GetParam().c_str(), with.wall, without.wall,
              with.gauges[0], with.gauges[1], with.gauges[2]);
}

// A round one and a rectangle in a coupled run: read once the grains are there, momentum booked as without them.
TEST_P(StressGauges, ReadInACoupledRun) {
  const Overrides gauges{
      {"obstacles.wall.gauges",
       "{round: {centre: [-14 mm, 15 mm], radius: 12 mm}, square: {centre: [16 mm, 15 mm], size: [20 mm, 24 mm]}}"},
      {"grains.engine", GetParam()},
      {"duration", "0.2 s"}};
  const Gauged run = watch_gauges(small_scene("coupled", gauges));
  ASSERT_EQ(run.list.size(), 2u);
  EXPECT_LT(largest_residual(run), 0.02);
  EXPECT_EQ(run.windows.front().stresses.at(0).normal, 0);
  double impulse[2] = {}, wall = 0;
  for (const WindowReport& w : run.windows) {
    ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
    for (int k : {0, 1}) impulse[k] += w.stresses[k].normal * run.list[k].area * w.length;
    wall += w.obstacles[0].force[0] * w.length;
  }
  EXPECT_GT(impulse[0], 0.05 * wall);
  EXPECT_GT(impulse[1], 0.05 * wall);
  EXPECT_LT(impulse[0] + impulse[1], wall);
}

TEST(StressGaugesOf, AnObstacleThatGrainsMeet) {
  const Overrides gauge{{"obstacles.wall.gauges", "{m: {centre: [0, 20 mm], radius: 10 mm}}"}};
  EXPECT_EQ(stress_gauges(small_scene("grains", gauge), {}).size(), 1u);
  EXPECT_TRUE(stress_gauges(small_scene("continuum", gauge), {}).empty());
  const Scene coupled = small_scene("coupled", gauge);
  EXPECT_EQ(stress_gauges(coupled, planned_zones(coupled)).size(), 1u);
  PlannedZone elsewhere;
  elsewhere.box = {0.45, 0.55, -0.07, 0.07};
  EXPECT_TRUE(stress_gauges(coupled, {elsewhere}).empty());
  const Gauged continuum = watch_gauges(small_scene("continuum", gauge));
  EXPECT_TRUE(continuum.list.empty());
  EXPECT_TRUE(continuum.windows.back().stresses.empty());
}

}  // namespace
}  // namespace couloir
