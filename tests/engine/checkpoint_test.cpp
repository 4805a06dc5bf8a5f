// A restored run has the bits of the run that wrote the checkpoint.
#include <gmock/gmock.h>

#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

namespace {

EngineSetup driven_box(const std::string& folder, int ranks) {
  EngineSetup setup = box(folder);
  setup.ranks = ranks;
  setup.gravity = {2, 0, -g};
  const double w = 8 * 1.12 * d;
  setup.faces = {{{0.3 * w, 0, 0}, {1, 0, 0}, {0, 1, 0}, w / 2, 2, 0.1 * w, 0.2 * w}};
  return setup;
}

}  // namespace

struct Checkpoint : OnEngine {};

INSTANTIATE_TEST_SUITE_P(On, Checkpoint, engines, name_of_engine);

TEST_P(Checkpoint, RestoredRunHasTheWritersBits) {
  for (const int ranks : OnEngine::ranks()) {
    Folder folder, other;
    const std::string path = folder.path + "/state";
    Advanced written, restored;
    {
      WorkerEngine engine(worker());
      engine.start(driven_box(folder.path, ranks));
      AdvanceRequest request = steps(1500);
      request.insert = lattice(8, 4);
      for (NewGrain& grain : request.insert) {
        if (grain.position[0] < 0.006) grain.face = 0, grain.segment = grain.position[1] < 0.018 ? 0 : 1;
      }
      const SegmentDrive drive{0.001, 0.05, -0.01, 0, 1e-5, false, {}};
      request.drives = {{drive, drive}};
      engine.advance(request);
      engine.checkpoint(path);
      engine.advance(steps(400));
      written = engine.advance(steps(400));
    }
    WorkerEngine engine(worker());
    engine.restore(driven_box(other.path, ranks), path);
    engine.advance(steps(400));
    restored = engine.advance(steps(400));
    EXPECT_EQ(restored.step, 2300);
    EXPECT_GT(restored.segments[0][0].mass, 0);
    EXPECT_TRUE(same_bits(written.grains, restored.grains)) << ranks << " ranks";
    EXPECT_EQ(written.surface_force, restored.surface_force);
    EXPECT_EQ(written.segments[0][1].velocity, restored.segments[0][1].velocity);
    EXPECT_EQ(written.drive_impulse, restored.drive_impulse);
  }
}

// Setting up again costs no momentum: forces on grains are not counted twice.
TEST_P(Checkpoint, DoesNotDisturbTheWriter) {
  Folder folder;
  WorkerEngine engine(worker());
  const EngineSetup setup = box(folder.path);
  engine.start(setup);
  AdvanceRequest request = steps(20000);  // at rest: what damping adds to a contact is then below what is compared
  request.insert = lattice(8, 4);
  engine.advance(request);
  Advanced before = engine.advance(steps(1));
  engine.checkpoint(folder.path + "/state");
  const Advanced after = engine.advance(steps(0));  // forces as set up anew at the same place
  EXPECT_TRUE(same_bits(before.grains, after.grains));
  const double weight = mass(after.grains) * g;
  for (std::size_t s = 0; s < 5; ++s) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(after.surface_force_last[s][k], before.surface_force_last[s][k], 1e-4 * weight);
  }
}

TEST_P(Checkpoint, MissingOrForeignFilesAreRefused) {
  Folder folder;
  WorkerEngine engine(worker());
  EXPECT_THAT(error_of([&] { engine.restore(box(folder.path), folder.path + "/none"); }),
              testing::HasSubstr("/none does not exist"));
  engine.start(box(folder.path));
  engine.advance(steps(5));
  engine.checkpoint(folder.path + "/state");
  engine.stop();
  engine.restore(box(folder.path), folder.path + "/state");
  EXPECT_EQ(engine.advance(steps(1)).step, 6) << "a state without grains";
  engine.stop();
  EXPECT_THAT(error_of([&] { engine.restore(driven_box(folder.path, 1), folder.path + "/state"); }),
              testing::HasSubstr("does not belong to this scene's zone"));
}
