// The virtual experiment against what is known: a slab whose grains cannot turn shows its base friction, whatever its slope.
#include "coupling/calibration/slab.hpp"

#include <stdlib.h>

#include <cmath>
#include <filesystem>

#include "coupling/cases/share_out.hpp"
#include "coupling/engine/worker_engine.hpp"
#include "gtest/gtest.h"

using namespace couloir;

namespace {

constexpr double d = 0.004;

struct Folder {
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "couloir-slab-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string path;
};

SlabSpec blocked_slab() {
  SlabSpec s;
  s.stock.diameter = d;
  s.stock.density = 1120;
  s.stock.length = 8 * d;
  s.stock.width = 6 * d;
  s.stock.depth = 5 * d;
  s.stock.rotation = Rotation::blocked;
  s.depth = 5 * d;
  s.slope = std::atan(0.3);
  s.speed = 1;
  s.settling = 0.1;
  s.duration = 0.1;
  s.window = 0.02;
  return s;
}

double mean_friction(const SlabCurve& c) {
  double mu = 0;
  for (const SlabPoint& p : c.points) mu += p.friction / static_cast<double>(c.points.size());
  return mu;
}

}  // namespace

TEST(Slab, ShowsItsBaseFrictionWhereGrainsCannotTurn) {
  Folder folder;
  WorkerEngine engine(worker_path("liggghts"));
  for (const double mu : {0.3, 0.45}) {
    SlabSpec s = blocked_slab();
    s.base_friction = mu;
    const SlabCurve c = slide(s, engine, folder.path, folder.path);
    ASSERT_EQ(c.points.size(), 5u);
    EXPECT_NEAR(mean_friction(c), mu, 0.005) << mu;
    EXPECT_NEAR(c.points.back().slip, 1, 0.02) << "it slides as a block";
    EXPECT_GT(c.grains, 150u);
  }
}

TEST(Slab, ShearsOnARoughBaseAndHeedsStop) {
  Folder folder;
  WorkerEngine engine(worker_path("liggghts"));
  SlabSpec s = blocked_slab();
  s.stock.rotation = Rotation::free;
  s.base = SlabBase::rough;
  s.slope = std::atan(0.45);
  s.speed = 0.2;
  const SlabCurve c = slide(s, engine, folder.path, folder.path);
  ASSERT_FALSE(c.points.empty());
  EXPECT_LT(c.points.front().slip, 0.5) << "the lowest layer stays behind";
  EXPECT_GT(mean_friction(c), 0.4);
  EXPECT_LT(mean_friction(c), 0.7);
  EXPECT_THROW(slide(s, engine, folder.path, folder.path, [] { return true; }), Stopped);
}

TEST(Slab, TheRoughBaseIsPeriodicAndRises) {
  const auto triangles = rough_base(0.04, 0.02, d);
  EXPECT_EQ(triangles.size(), 100u);
  double top = 0;
  for (const Triangle& t : triangles)
    for (const Vec& v : {t.a, t.b, t.c}) {
      EXPECT_GE(v[2], 0);
      EXPECT_LE(v[2], d);
      top = std::max(top, v[2]);
      for (const Triangle& u : triangles)
        for (const Vec& w : {u.a, u.b, u.c}) {
          if (v[0] == 0 && w[0] == 0.04 && v[1] == w[1]) {
            EXPECT_EQ(v[2], w[2]);
          }
        }
    }
  EXPECT_GT(top, 0.8 * d);
}
