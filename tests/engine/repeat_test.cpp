// The same run has the same bits.
#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

namespace {

Advanced run(int ranks) {
  Folder folder;
  EngineSetup setup = box(folder.path);
  setup.ranks = ranks;
  setup.gravity = {2, 0, -g};
  LiggghtsEngine engine;
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

TEST(Repeat, OneRankHasTheSameBitsTwice) {
  const Advanced a = run(1), b = run(1);
  EXPECT_EQ(a.grains.size(), 253u);
  EXPECT_TRUE(same_bits(a.grains, b.grains));
  EXPECT_EQ(a.surface_force, b.surface_force);
  EXPECT_EQ(a.kinetic_energy, b.kinetic_energy);
}

TEST(Repeat, TwoRanksHaveTheSameBitsTwice) {
  const Advanced a = run(2), b = run(2);
  EXPECT_EQ(a.grains.size(), 253u);
  EXPECT_TRUE(same_bits(a.grains, b.grains));
  EXPECT_EQ(a.surface_force, b.surface_force);
}
