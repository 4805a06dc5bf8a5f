#include "coupling/engine/packing.hpp"

#include <fstream>

#include "coupling/engine/packing_cache.hpp"
#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

namespace {

PackingSpec small() {
  PackingSpec s;
  s.diameter = d;
  s.density = density;
  s.length = 12 * d;
  s.width = 8 * d;
  s.depth = 8 * d;
  return s;
}

bool same(const Packing& a, const Packing& b) {
  if (a.grains.size() != b.grains.size() || a.depth != b.depth || a.solid_fraction != b.solid_fraction) return false;
  return std::memcmp(a.grains.data(), b.grains.data(), a.grains.size() * sizeof(Packing::Grain)) == 0;
}

}  // namespace

TEST(Packing, IsDenseKeptAndRepeatable) {
  Folder work, cache, other;
  WorkerEngine engine(worker_path("liggghts"));
  double last = 0;
  const Packing p = settled_packing(small(), engine, cache.path, work.path, [&](double done) { last = done; });
  EXPECT_GT(last, 0.3);
  EXPECT_LE(last, 1);
  EXPECT_GT(p.solid_fraction, 0.53);
  EXPECT_LT(p.solid_fraction, 0.60);
  EXPECT_GE(p.depth, 8 * d);
  EXPECT_LT(p.depth, 11 * d);
  for (std::size_t i = 0; i < p.grains.size(); ++i) {
    const auto& q = p.grains[i];
    EXPECT_TRUE(q.x >= 0 && q.x < p.length && q.y >= 0 && q.y < p.width);
    EXPECT_GT(q.z, 0.9 * q.r);
    EXPECT_TRUE(q.r >= 0.45 * d && q.r <= 0.55 * d);
    EXPECT_TRUE(i == 0 || p.grains[i - 1].x <= q.x);
  }
  // kept: the engine cannot have made it again, for it has no worker
  WorkerEngine none("/nowhere/worker");
  EXPECT_TRUE(same(p, settled_packing(small(), none, cache.path, work.path)));
  // a cache that cannot be written costs only time, and is said
  std::string said;
  const auto say = [&](const std::string& what) { said = what; };
  EXPECT_TRUE(same(p, settled_packing(small(), engine, "/dev/null/packings", work.path, {}, say)));
  EXPECT_NE(said.find("could not be kept in /dev/null/packings"), std::string::npos) << said;
  // made again elsewhere: the same bits; another seed: other grains
  EXPECT_TRUE(same(p, settled_packing(small(), engine, other.path, work.path)));
  PackingSpec seeded = small();
  seeded.seed = 30011;
  EXPECT_FALSE(read_packing(seeded, cache.path).has_value());
  EXPECT_FALSE(same(p, settled_packing(seeded, engine, cache.path, work.path)));
}

TEST(Packing, ADamagedFileIsNotRead) {
  Folder cache;
  Packing p;
  p.length = p.width = p.depth = 1;
  p.solid_fraction = 0.1 + 0.2;
  p.grains = {{0.1, 0.2, 0.3, 1.0 / 3.0}, {0.4, 0.5, 0.6, 0.7}};
  write_packing(small(), p, cache.path);
  const auto kept = read_packing(small(), cache.path);
  ASSERT_TRUE(kept.has_value());
  EXPECT_TRUE(same(p, *kept));
  const std::string file = packing_file(small(), cache.path);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 80);
  EXPECT_FALSE(read_packing(small(), cache.path).has_value());
}

TEST(Packing, StableTimestep) {
  // d = 5 mm, E = 5 MPa, 2650 kg/m3: 5e-5 s was measured to be 16 % of the Rayleigh time
  EXPECT_NEAR(stable_timestep(ContactLaw::hertz, {0.005, 0, 2650, 5e6, 0.25}), 5e-5, 0.05e-5);
}
