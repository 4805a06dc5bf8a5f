// The three modes of one scene, with the real engine: what each must keep.

#include "small_run.hpp"

namespace couloir {
namespace {

double impulse(const Watched& run) {
  double sum = 0;
  for (const WindowReport& w : run.windows) sum += w.obstacles[0].force[0] * w.length;
  return sum;
}

TEST(Modes, CoupledKeepsMassInEveryWindowAndReadsTheWall) {
  const Watched run = watch(small_scene("coupled"), options_in(fresh_folder("coupled")));
  ASSERT_FALSE(run.windows.empty());
  for (const WindowReport& w : run.windows) ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
  for (const WindowReport& w : run.windows) EXPECT_LT(w.max_overlap, 0.1) << "at " << w.time;
  double residual = 0;
  for (const WindowReport& w : run.windows)
    if (w.momentum.scale > 0) residual = std::max(residual, std::abs(w.momentum.residual) / w.momentum.scale);
  EXPECT_LT(residual, 0.02);
  EXPECT_GT(run.windows.back().inserted, 500);
  EXPECT_GT(run.windows.back().returned, 50);
  EXPECT_GT(impulse(run), 0);
  EXPECT_EQ(run.end.status, "done");
}

// Finer cells along the zone's rim, as the flow asks for them and in a box that one of its edges crosses.
TEST(Modes, CoupledOverCellsOfThreeSizes) {
  const Scene scene = small_scene("coupled", {{"continuum.adapt", "{levels: 1, interval: 4}"},
                                              {"continuum.refine", "[{x: [250 mm, 300 mm], y: [-20 mm, 40 mm], levels: 2}]"},
                                              {"continuum.block", "4"}});
  const Watched run = watch(scene, options_in(fresh_folder("coupled_refined")));
  ASSERT_EQ(run.end.status, "done");
  double residual = 0;
  for (const WindowReport& w : run.windows) {
    ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
    if (w.momentum.scale > 0) residual = std::max(residual, std::abs(w.momentum.residual) / w.momentum.scale);
  }
  EXPECT_LT(residual, 0.02);
  ASSERT_EQ(run.windows.back().levels.size(), 3u);
  EXPECT_GT(run.windows.back().inserted, 500);
  const Watched uniform = watch(small_scene("coupled"), options_in(fresh_folder("coupled_uniform")));
  EXPECT_NEAR(impulse(run) / impulse(uniform), 1, 0.1);
}

TEST(Modes, AZoneMayEndWithTheDomain) {
  const Watched run =
      watch(small_scene("coupled", {{"grains.zone", "{x: [270 mm, 600 mm], y: [-100 mm, 100 mm]}"}, {"duration", "0.4 s"}}),
            options_in(fresh_folder("edge")));
  for (const WindowReport& w : run.windows) ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
  EXPECT_GT(run.windows.back().mass.left_domain, 0.05);
}

// The other engine, the other law: mass and momentum kept as above, and the same wall read.
TEST(Modes, YadeCarriesACoupledRunWithEitherContactLaw) {
  for (const char* contact : {"hertz", "kelvin_voigt"}) {
    const Overrides law{{"grains.contact", contact}};
    Overrides yade = law;
    yade.push_back({"grains.engine", "yade"});
    const Watched run = watch(small_scene("coupled", yade), options_in(fresh_folder("yade")));
    EXPECT_EQ(run.end.status, "done");
    EXPECT_NE(run.end.engine.find("YADE"), std::string::npos);
    double residual = 0;
    for (const WindowReport& w : run.windows) {
      ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
      EXPECT_LT(w.max_overlap, 0.1) << "at " << w.time;
      if (w.momentum.scale > 0) residual = std::max(residual, std::abs(w.momentum.residual) / w.momentum.scale);
    }
    EXPECT_LT(residual, 0.02);
    EXPECT_GT(run.windows.back().inserted, 500);
    EXPECT_GT(run.windows.back().returned, 50);
    const double liggghts = impulse(watch(small_scene("coupled", law), options_in(fresh_folder("liggghts"))));
    EXPECT_NEAR(impulse(run) / liggghts, 1, 0.1) << contact;
  }
}

TEST(Modes, TwoRanksCarryACoupledRun) {
  const Watched run =
      watch(small_scene("coupled", {{"grains.ranks", "2"}, {"duration", "0.15 s"}}), options_in(fresh_folder("ranks")));
  for (const WindowReport& w : run.windows) ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
  EXPECT_GT(run.windows.back().grains, 500);
}

TEST(Modes, TheEngineStartsWhenTheFlowIsNearAndSaysSo) {
  const Watched run = watch(small_scene("coupled"), options_in(fresh_folder("start")));
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_NE(run.events[0].what.find("within reach of the zone"), std::string::npos);
  EXPECT_GT(run.events[0].time, 0.01);
  EXPECT_LT(run.events[0].time, 0.12);
}

TEST(Modes, AFlowThatNeverComesNearStartsNoEngine) {
  const Watched run = watch(small_scene("coupled", {{"duration", "0.02 s"}}), options_in(fresh_folder("never")));
  EXPECT_TRUE(run.events.empty());
  EXPECT_EQ(run.end.engine, "");
  EXPECT_EQ(run.windows.back().engine_steps, 0);
}

TEST(Modes, ContinuumRunsEitherScheme) {
  for (const char* scheme : {"central_upwind", "noc"}) {
    const Watched run = watch(small_scene("continuum", {{"continuum.scheme", scheme}, {"obstacles", "{}"}, {"grains", "{}"}}),
                              options_in(fresh_folder(scheme)));
    EXPECT_EQ(run.end.status, "done");
    ASSERT_FALSE(run.windows.empty());
    double residual = 0;
    for (const WindowReport& w : run.windows) {
      ASSERT_LE(w.mass.relative_error(), 1e-12) << scheme << " at " << w.time;
      if (w.momentum.scale > 0) residual = std::max(residual, std::abs(w.momentum.residual) / w.momentum.scale);
    }
    EXPECT_LT(residual, 1e-12) << scheme;
    EXPECT_GT(run.windows.back().max_speed, 1) << scheme;
    EXPECT_GE(run.windows.back().min_depth, 0) << scheme;
  }
}

void expect_grains_kept(const Watched& run) {
  double left = 0, left_before = 0;
  for (const WindowReport& w : run.windows) {
    ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
    // Where a grain was taken out, the bed's force on it at that instant still counts for half a step.
    const bool taken = left > left_before;
    ASSERT_LE(std::abs(w.momentum.residual), (taken ? 1e-5 : 1e-9) * w.momentum.scale) << "at " << w.time;
    left_before = left;
    left = w.mass.left_domain;
  }
  EXPECT_GT(impulse(run), 0);
}

TEST(Modes, GrainsKeepMassAndMomentum) {
  expect_grains_kept(watch(small_scene("grains"), options_in(fresh_folder("grains"))));
}

TEST(Modes, GrainsOfYadeKeepMassAndMomentum) {
  expect_grains_kept(
      watch(small_scene("grains", {{"grains.engine", "yade"}, {"duration", "0.17 s"}}), options_in(fresh_folder("yade_grains"))));
}

TEST(Modes, ContinuumKeepsMassAndMomentum) {
  const Watched run = watch(small_scene("continuum"), options_in(fresh_folder("continuum")));
  for (const WindowReport& w : run.windows) {
    ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
    ASSERT_LE(std::abs(w.momentum.residual), 1e-11 * w.momentum.scale) << "at " << w.time;
  }
  EXPECT_GT(impulse(run), 0);
}

TEST(Modes, AllThreeReadTheSameWall) {
  const double grains = impulse(watch(small_scene("grains"), options_in(fresh_folder("g"))));
  const double coupled = impulse(watch(small_scene("coupled"), options_in(fresh_folder("k"))));
  const double continuum = impulse(watch(small_scene("continuum"), options_in(fresh_folder("c"))));
  EXPECT_NEAR(coupled / grains, 1, 0.25);
  EXPECT_NEAR(continuum / grains, 1, 0.5);
}

}  // namespace
}  // namespace couloir
