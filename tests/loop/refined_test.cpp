// Runs on refined meshes, from the scene to what observers are told.

#include <numeric>

#include "coupling/loop/flow_side.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/release.hpp"
#include "small_run.hpp"

namespace couloir {
namespace {

struct Seen : Watched {
  std::vector<BlocksView> blocks;
  std::vector<double> base;  // depths of the last frame
  void on_frame(const FrameView& f) override {
    blocks.push_back(f.blocks ? *f.blocks : BlocksView());
    base = *f.h;
  }
};

Seen see(const Overrides& more) {
  Seen seen;
  run_scene(small_scene("continuum", more), options_in(fresh_folder("refined")), {&seen});
  return seen;
}

const char* about_the_wall = "[{around: wall, up: 60 mm, down: 20 mm, left: 20 mm, right: 20 mm, levels: 2}]";

// Mass and momentum close in each window.
void expect_closed(const Seen& run) {
  for (const WindowReport& w : run.windows) {
    ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
    ASSERT_LE(std::abs(w.momentum.residual), 1e-12 * w.momentum.scale) << "at " << w.time;
  }
}

TEST(RefinedRun, BoxesAboutAnObstacle) {
  const Seen run = see({{"continuum.refine", about_the_wall}, {"continuum.block", "8"}});
  expect_closed(run);
  ASSERT_EQ(run.windows.back().levels.size(), 3u);
  const LevelCells& finest = run.windows.back().levels[2];
  EXPECT_EQ(finest.level, 2);
  EXPECT_DOUBLE_EQ(finest.cell, 0.0025);
  EXPECT_EQ(finest.cells, 64 * finest.blocks);
  ASSERT_EQ(run.blocks.size(), 6u);
  const BlocksView& last = run.blocks.back();
  EXPECT_EQ(last.places, run.blocks.front().places) << "boxes stay where they are";
  // The coarsest cells of the frame are the means of the finer ones.
  std::size_t first = 0;
  double finer = 0;
  std::vector<double> mean(run.base.size(), 0.0);
  for (const BlockPlace& b : last.places) {
    for (int j = 0; j < b.ny; ++j)
      for (int i = 0; i < b.nx; ++i) {
        const double h = last.h[first + std::size_t(j) * b.nx + i];
        mean[std::size_t((b.j0 + j) >> b.level) * 60 + ((b.i0 + i) >> b.level)] += std::ldexp(h, -2 * b.level);
        if (b.level > 0) finer += h;
      }
    first += std::size_t(b.nx) * b.ny;
  }
  EXPECT_EQ(first, last.h.size());
  EXPECT_GT(finer, 0) << "the flow has reached the finer cells";
  for (std::size_t c = 0; c < mean.size(); ++c) ASSERT_NEAR(mean[c], run.base[c], 1e-15) << c;
}

TEST(RefinedRun, AMeshThatFollowsTheFlow) {
  const Seen run = see({{"continuum.adapt", "{levels: 2, interval: 4, obstacle: 10 mm}"}, {"continuum.block", "4"}});
  expect_closed(run);
  EXPECT_NE(run.blocks.front().places, run.blocks[2].places);
  EXPECT_NE(run.blocks.back().places, run.blocks[2].places);
  EXPECT_EQ(run.windows.back().levels.size(), 3u);
}

TEST(RefinedRun, NestedGridsOfNoc) {
  const Seen run =
      see({{"continuum.refine", about_the_wall}, {"continuum.scheme", "noc"}, {"obstacles.wall.method", "elevation"}});
  expect_closed(run);
  ASSERT_EQ(run.windows.back().levels.size(), 3u);
  EXPECT_EQ(run.windows.back().levels[0].cells, 60 * 20);
  const BlocksView& last = run.blocks.back();
  ASSERT_EQ(last.places.size(), 3u);
  EXPECT_EQ(last.places[0], (BlockPlace{0, 0, 0, 60, 20}));
  EXPECT_TRUE(std::equal(run.base.begin(), run.base.end(), last.h.begin()));
  // A patch's parent holds its means.
  const BlockPlace &one = last.places[1], &two = last.places[2];
  const std::size_t first_one = 1200, first_two = first_one + std::size_t(one.nx) * one.ny;
  EXPECT_EQ(last.h.size(), first_two + std::size_t(two.nx) * two.ny);
  double most = 0;
  for (int j = 0; j < two.ny; j += 2)
    for (int i = 0; i < two.nx; i += 2) {
      double sum = 0;
      for (int n = 0; n < 4; ++n) sum += 0.25 * last.h[first_two + std::size_t(j + n / 2) * two.nx + i + n % 2];
      const int pi = (two.i0 + i) / 2 - one.i0, pj = (two.j0 + j) / 2 - one.j0;
      ASSERT_NEAR(last.h[first_one + std::size_t(pj) * one.nx + pi], sum, 1e-15) << i << " " << j;
      most = std::max(most, sum);
    }
  EXPECT_GT(most, 0.001);
}

TEST(RefinedRun, OneSizeOfCellsHasNoBlocks) {
  const Seen run = see({{"duration", "10 ms"}});
  EXPECT_TRUE(run.blocks.front().places.empty());
  EXPECT_TRUE(run.windows.back().levels.empty());
}

// Whatever the mesh does while the release is laid, its mass is exact.
TEST(RefinedRun, ReleaseHasItsMassOnAnyMesh) {
  for (const char* more : {"{levels: 1}", "{levels: 3, gradient: 0.02}"}) {
    const Scene scene =
        small_scene("continuum", {{"release", "{kind: cap, centre: [150 mm, 3 mm], base_radius: 77 mm, height: 40 mm}"},
                                  {"continuum.adapt", more},
                                  {"continuum.block", "8"}});
    FlowSide flow(scene, reference_surface(scene), 1);
    EXPECT_NEAR(flow.initial_mass(), release_volume(scene) * scene.material.density, 2e-12 * flow.initial_mass()) << more;
    EXPECT_GT(flow.model().blocks().size(), 24u);
  }
}

// A top of a quarter of a coarsest cell's width has depths of its own in the finest cells.
TEST(RefinedRun, DepthOnTopIsThatOfTheFinestCells) {
  const Scene scene =
      small_scene("continuum", {{"obstacles.wall", "{position: [400 mm, 0], size: [60 mm, 60 mm, 20 mm], shape: tetrahedron}"},
                                {"continuum.refine", about_the_wall},
                                {"continuum.block", "8"}});
  FlowSide flow(scene, reference_surface(scene), 1);
  // The peak is at x = 440 mm; depth grows towards it.
  flow.model().set([](double x, double y) { return FlowState{0.1 - std::hypot(x - 0.44, y), 0, 0}; });
  const double depth = flow.force(0, 1e-3).depth_on_top;
  EXPECT_GT(depth, 0.1 - 0.0025) << "a finest cell about the peak";
  EXPECT_LE(depth, 0.1);
}

// Cells of elevation in the records are those of the solver: means of the finest, so that a lake over them is level.
TEST(RefinedRun, BedOfTheRecordsIsTheSolversOwn) {
  const Scene scene =
      small_scene("continuum", {{"obstacles.wall", "{position: [400 mm, 0], size: [60 mm, 60 mm, 20 mm], shape: tetrahedron}"},
                                {"continuum.refine", about_the_wall},
                                {"continuum.block", "8"}});
  FlowSide flow(scene, reference_surface(scene), 1);
  flow.solver().fill_to(0.05);
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 60; ++i)
      ASSERT_NEAR(flow.model().at(i, j).h + flow.bed()[std::size_t(j) * 60 + i], 0.05, 1e-15) << i << " " << j;
}

}  // namespace
}  // namespace couloir
