// Same input, same bits.

#include "small_run.hpp"

namespace couloir {
namespace {

void expect_same_bits(const Watched& a, const Watched& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t k = 0; k < a.frames.size(); ++k) EXPECT_EQ(a.frames[k], b.frames[k]) << "frame " << k;
  ASSERT_EQ(a.windows.size(), b.windows.size());
  for (std::size_t k = 0; k < a.windows.size(); ++k) ASSERT_EQ(a.windows[k].obstacles[0].force, b.windows[k].obstacles[0].force);
}

TEST(Repeat, CoupledTwice) {
  const Scene scene = small_scene("coupled", {{"duration", "0.15 s"}});
  expect_same_bits(watch(scene, options_in(fresh_folder("k1"))), watch(scene, options_in(fresh_folder("k2"))));
}

TEST(Repeat, GrainsTwice) {
  const Scene scene = small_scene("grains", {{"duration", "0.15 s"}});
  expect_same_bits(watch(scene, options_in(fresh_folder("g1"))), watch(scene, options_in(fresh_folder("g2"))));
}

TEST(Repeat, ContinuumWithOneAndTwoThreads) {
  const Scene scene = small_scene("continuum");
  RunOptions two = options_in(fresh_folder("c2"));
  two.threads = 2;
  expect_same_bits(watch(scene, options_in(fresh_folder("c1"))), watch(scene, two));
}

}  // namespace
}  // namespace couloir
