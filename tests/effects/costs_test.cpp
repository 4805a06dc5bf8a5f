#include "coupling/loop/costs.hpp"

#include <map>
#include <set>

#include "continuum/scheme/laps.hpp"
#include "coupling/plan/effects.hpp"
#include "coupling/scene/effect_names.hpp"
#include "tests/loop/small_run.hpp"

namespace couloir {
namespace {

std::map<std::string, double> by_effect(const RunEnd& end) {
  std::map<std::string, double> out;
  for (const PartCost& c : end.costs) out[c.effect] += c.seconds;
  return out;
}

TEST(Costs, NameEffectsOfThePlan) {
  const std::set<std::string> names(effect_names.begin(), effect_names.end());
  for (int p = 0; p < part_count; ++p) EXPECT_TRUE(names.contains(effect_of(static_cast<StepPart>(p)))) << p;
}

TEST(Costs, AreTheWholeProcessorTime) {
  for (const char* mode : {"continuum", "coupled", "grains"}) {
    const Watched run = watch(small_scene(mode, {{"duration", "0.1 s"}}), options_in(fresh_folder("costs")));
    EXPECT_NEAR(sum(run.end.costs), run.end.cpu, 1e-9 * run.end.cpu + 1e-12) << mode;
    for (const PartCost& c : run.end.costs) EXPECT_GT(c.seconds, 0) << mode << " " << c.part;
  }
}

TEST(Costs, AreOfEffectsThatAreOn) {
  const Scene scene = small_scene("coupled", {{"duration", "0.15 s"}, {"continuum.adapt.levels", "1"}});
  const auto costs = by_effect(watch(scene, options_in(fresh_folder("costs"))).end);
  for (const char* name : {"depth_averaged_flow", "basal_friction", "earth_pressure", "refinement", "coupling", "grain_engine"})
    EXPECT_GT(costs.at(name), 0) << name;
  EXPECT_FALSE(costs.contains("planes"));
}

TEST(Costs, GoOnWithARunThatWasBrokenOff) {
  RunOptions options = options_in(fresh_folder("costs"));
  options.checkpoints = options.work_dir + "/checkpoint";
  const Scene scene = small_scene("continuum", {{"duration", "0.2 s"}, {"record.checkpoint", "50 ms"}});
  Watched first;
  long asked = 0;
  options.interrupted = [&] { return ++asked > 100; };
  const RunEnd broken = run_scene(scene, options, {&first});
  ASSERT_EQ(broken.status, "interrupted");
  options.interrupted = [] { return false; };
  options.resume = true;
  const RunEnd whole = run_scene(scene, options, {&first});
  EXPECT_NEAR(sum(whole.costs), whole.cpu, 1e-9 * whole.cpu + 1e-12);
  EXPECT_GT(by_effect(whole).at("depth_averaged_flow"), by_effect(broken).at("depth_averaged_flow"));
}

TEST(Laps, LeaveOutWhatAnotherProgramTook) {
  const auto spin = [](double seconds) {
    const auto start = Laps::Clock::now();
    while (std::chrono::duration<double>(Laps::Clock::now() - start).count() < seconds) {
    }
  };
  Laps laps;
  laps.start(true);
  for (int k = 0; k < 40; ++k) {
    spin(k == 30 ? 0.1 : 1e-5);
    laps.lap(StepPart::update);
  }
  EXPECT_GT(sum(laps.times()), 38e-5);
  EXPECT_LT(sum(laps.times()), 0.1);
}

TEST(StepTimer, SharesOutWhatItSawAsAWhole) {
  StepTimer timer;
  Laps kernel;
  const auto spin = [](double seconds) {
    const auto start = Laps::Clock::now();
    while (std::chrono::duration<double>(Laps::Clock::now() - start).count() < seconds) {
    }
  };
  for (int step = 0; step < 14; ++step) {  // two of them are timed part by part
    const StepTimer::Span span(timer, step, {&kernel});
    {
      const StepTimer::Span within(timer, step);  // counts with the outer one
    }
    timer.lap(StepPart::order);
    kernel.start();
    spin(3e-4);
    kernel.lap(StepPart::fluxes);
    spin(1e-4);
    kernel.lap(StepPart::update);
    timer.lap_kernels();
    timer.apart(StepPart::mesh, [&] { spin(1e-4); });
  }
  PartTimes times = timer.times({&kernel});
  EXPECT_GE(sum(times), 14 * 5e-4);
  EXPECT_GE(at(times, StepPart::mesh), 14 * 1e-4);  // in each
  EXPECT_GT(at(times, StepPart::fluxes), 14 * 2e-4);
  EXPECT_GT(at(times, StepPart::fluxes), at(times, StepPart::update));
  EXPECT_EQ(at(times, StepPart::planes), 0);
}

}  // namespace
}  // namespace couloir
