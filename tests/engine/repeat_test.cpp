// The same run has the same bits.
#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

namespace {

Advanced run(const std::string& worker, int ranks) {
  Folder folder;
  EngineSetup setup = box(folder.path);
  setup.ranks = ranks;
  setup.gravity = {2, 0, -g};
  WorkerEngine engine(worker);
  engine.start(setup);
  AdvanceRequest request = steps(1500);
  request.insert = lattice(8, 3);
  engine.advance(request);
  request = steps(1500);
  request.insert = lattice(8, 1, 1000, 0.04);
  request.remove = {5, 6, 7};
  Advanced a = engine.advance(request);
  engine.stop();
  return a;
}

}  // namespace

struct Repeat : OnEngine {};

INSTANTIATE_TEST_SUITE_P(On, Repeat, engines, name_of_engine);

TEST_P(Repeat, OneRankHasTheSameBitsTwice) {
  const Advanced a = run(worker(), 1), b = run(worker(), 1);
  EXPECT_EQ(a.grains.size(), 253u);
  EXPECT_TRUE(same_bits(a.grains, b.grains));
  EXPECT_EQ(a.surface_force, b.surface_force);
  EXPECT_EQ(a.kinetic_energy, b.kinetic_energy);
}

TEST(RepeatRanks, TwoRanksHaveTheSameBitsTwice) {
  const Advanced a = run(worker_path("liggghts"), 2), b = run(worker_path("liggghts"), 2);
  EXPECT_EQ(a.grains.size(), 253u);
  EXPECT_TRUE(same_bits(a.grains, b.grains));
  EXPECT_EQ(a.surface_force, b.surface_force);
}
