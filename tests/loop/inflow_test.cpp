// A time-dependent inflow keeps the ledgers closed, in the continuum and through a zone of grains; gauges see it pass.
#include "coupling/scene/inflow.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "small_run.hpp"

namespace couloir {
namespace {

Overrides fed(Overrides more = {}) {
  more.insert(more.begin(), {{"release", "{kind: none}"},
                             {"boundaries.upstream",
                              "{inflow: {kind: hydrograph, hydrograph: [[0, 20 mm, 1.5], [60 ms, 40 mm, 2], "
                              "[150 ms, 10 mm, 1.5]]}}"},
                             {"record.gauges", "{up: {position: [100 mm, 0]}, wall: {position: [395 mm, 5 mm]}}"}});
  return more;
}

void expect_closed(const Watched& run) {
  for (const WindowReport& w : run.windows) {
    EXPECT_LT(w.mass.relative_error(), 1e-12) << w.time;
    EXPECT_GE(w.min_depth, 0);
  }
}

TEST(Inflow, ClosesTheLedgersOfTheContinuum) {
  const std::string folder = fresh_folder("inflow_continuum");
  const Scene scene = small_scene("continuum", fed({{"duration", "0.6 s"}}));
  const Watched run = watch(scene, options_in(folder));
  expect_closed(run);
  const WindowReport& last = run.windows.back();
  EXPECT_EQ(last.mass.initial, 0);
  const double entered = scene.material.density * scene.terrain.width * inflow_volume(scene, scene.sides[0]);
  EXPECT_NEAR(last.mass.entered, entered, 1e-9 * entered);
  EXPECT_GT(last.mass.left_domain, 0);
  for (const WindowReport& w : run.windows) EXPECT_LT(std::abs(w.momentum.residual), 1e-12 * w.momentum.scale + 1e-15);
  ASSERT_EQ(last.gauges.size(), 2u);
  double deepest = 0;
  for (const WindowReport& w : run.windows) deepest = std::max(deepest, w.gauges[0].depth);
  EXPECT_GT(deepest, 0.015);
  EXPECT_LT(deepest, 0.045);
}

TEST(Inflow, ClosesTheLedgersOfTheCoupledRun) {
  const std::string folder = fresh_folder("inflow_coupled");
  const Watched run = watch(small_scene("coupled", fed()), options_in(folder));
  expect_closed(run);
  const WindowReport& last = run.windows.back();
  EXPECT_EQ(last.mass.initial, 0);
  EXPECT_GT(last.mass.grains, 0);
  EXPECT_GT(last.mass.entered, last.mass.grains);
  ASSERT_EQ(last.gauges.size(), 2u);
  double deepest = 0;
  for (const WindowReport& w : run.windows) deepest = std::max(deepest, w.gauges[1].depth);
  EXPECT_GT(deepest, 0.005) << "the gauge in the zone sees the grains";
}

// A strip of cells brings it to them.
TEST(Inflow, FeedsGrainsAlone) {
  const Scene scene = small_scene("grains", fed({{"duration", "0.3 s"}}));
  const Watched run = watch(scene, options_in(fresh_folder("inflow_grains")));
  ASSERT_EQ(run.end.status, "done");
  expect_closed(run);
  const WindowReport& last = run.windows.back();
  const double entered = scene.material.density * scene.terrain.width * inflow_volume(scene, scene.sides[0]);
  EXPECT_NEAR(last.mass.entered, entered, 1e-9 * entered);
  EXPECT_GT(last.mass.grains + last.mass.left_domain, 0.9 * entered) << "little stays in the strip";
  double impulse = 0;
  for (const WindowReport& w : run.windows) {
    impulse += w.obstacles[0].force[0] * w.length;
    ASSERT_LT(w.max_overlap, 0.15) << w.time;
    EXPECT_LT(std::abs(w.momentum.residual), 0.03 * w.momentum.scale + 1e-15) << w.time;
  }
  EXPECT_GT(impulse, 0.01);
}

// summary.json holds the events.
TEST(Inflow, ASiloOfGrainsWithoutSizeIsToldAsAnAssumption) {
  const auto told = [](const std::string& material) {
    const Overrides silo{{"material", material},
                         {"release", "{kind: none}"},
                         {"boundaries.upstream", "{inflow: {kind: silo, gate: 20 mm}}"},
                         {"duration", "2 ms"}};
    std::string all;
    for (const Event& e : watch(small_scene("continuum", silo), options_in(fresh_folder("inflow_silo"))).events) all += e.what;
    return all;
  };
  EXPECT_THAT(told("yellow_sand"),
              testing::HasSubstr("warning: The material has no diameter: the silo's rate upstream is assumed"));
  EXPECT_EQ(told("vestolen"), "");
}

}  // namespace
}  // namespace couloir
