// Many grains: a column that collapses into a heap, and a silo that runs out through a slot; both engines.
#include <algorithm>

#include "figures.hpp"
#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

struct Granular : OnEngine {};

INSTANTIATE_TEST_SUITE_P(On, Granular, engines, name_of_engine);

namespace {

constexpr double periodic_width = 5 * d;

void cut_off(Packing& p, double height) {
  std::erase_if(p.grains, [&](const Packing::Grain& grain) { return grain.z + grain.r > height; });
}

// A settled block, periodic along x and y, cut off at `height`. Both engines and all tests get the same.
Packing block(double length, double height, const std::string& folder) {
  PackingSpec spec;
  spec.diameter = d;
  spec.length = length;
  spec.width = periodic_width;
  spec.depth = height;
  spec.density = density;
  spec.base_friction = 0.5;
  WorkerEngine engine(worker_path("liggghts"));
  const std::string kept = COULOIR_BINARY_DIR "/test_packings";
  std::filesystem::create_directories(kept);
  Packing p = settled_packing(spec, engine, kept, folder);
  cut_off(p, height);
  return p;
}

// With the block's left end at x = 0, at rest.
std::vector<NewGrain> at_rest(const Packing& p) {
  std::vector<NewGrain> grains;
  for (const Packing::Grain& grain : p.grains) {
    NewGrain n;
    n.id = static_cast<std::int64_t>(grains.size()) + 1;
    n.position = {grain.x + 0.55 * d, grain.y, grain.z};
    n.radius = grain.r;
    grains.push_back(n);
  }
  return grains;
}

EngineSetup channel(const std::string& folder, double length, double height) {
  EngineSetup s = box(folder);
  s.lo = {-d, 0, -8 * d};
  s.hi = {length + d, periodic_width, height};
  s.periodic = {false, true, false};
  s.surfaces.clear();
  return s;
}

EngineSurface upright(const char* name, double x, double height, double friction) {
  return {name, rectangle({x, 0, 0}, {0, periodic_width, 0}, {0, 0, height}), friction, 0.15};
}

EngineSurface level(const char* name, double from, double to) {
  EngineSurface s{name, {}, 0.5, 0.15};
  const int tiles = static_cast<int>(std::ceil((to - from) / (5 * d)));  // LIGGGHTS takes no triangle as long as the channel
  const double size = (to - from) / tiles;
  for (int n = 0; n < tiles; ++n)
    for (const Triangle& t : rectangle({from + n * size, 0, 0}, {size, 0, 0}, {0, periodic_width, 0})) s.triangles.push_back(t);
  return s;
}

// [m] where the heap's depth, in slices of a diameter, falls below half a diameter.
double reach(const Grains& grains, double solid_fraction) {
  std::vector<double> depth(100, 0.0);
  for (std::size_t i = 0; i < grains.size(); ++i)
    depth.at(static_cast<std::size_t>(grains.x[i] / d)) +=
        mass(grains.radius[i]) / density / (solid_fraction * d * periodic_width);
  std::size_t k = depth.size() - 1;
  while (k > 0 && depth[k - 1] < 0.5 * d) --k;
  return k == 0 ? 0 : d * (static_cast<double>(k) - 0.5 + (depth[k - 1] - 0.5 * d) / (depth[k - 1] - depth[k]));
}

}  // namespace

namespace {

struct Collapse {
  double runout;  // in lengths of the column
  double weight_on_floor, wall_and_floor;
};

// A column of a length of 15 d and as high, of grains with these frictions.
Collapse collapse(const std::string& worker, double friction, double rolling_friction) {
  Folder folder;
  const double length = 15 * d, x1 = 60 * d;
  const Packing packing = block(length, length, folder.path);
  EngineSetup setup = channel(folder.path, x1, length + 8 * d);
  setup.friction = friction;
  setup.rolling_friction = rolling_friction;
  setup.surfaces = {level("floor", 0, x1), upright("wall", 0, length + 4 * d, 0)};
  WorkerEngine engine(worker);
  engine.start(setup);
  AdvanceRequest request = steps(std::llround(0.5 / setup.timestep));
  request.insert = at_rest(packing);
  engine.advance(request);
  const Advanced a = engine.advance(steps(2000));
  return {(reach(a.grains, packing.solid_fraction) - length) / length, -a.surface_force[0][2] / (mass(a.grains) * g),
          -a.surface_force[1][0] / a.surface_force[0][0]};
}

constexpr double lube = 1.2;  // Lube et al., Phys. Rev. E 72 (2005) 041301: a plane column runs out by 1.2 a L where a < 1.8

}  // namespace

// Frictions that show phi = 33 deg (docs/calibration.md), as sands have it. The heap's weight is on the floor, and the floor's
// friction holds what the wall pushes.
TEST_P(Granular, ColumnCollapsesAsFarAsMeasured) {
  const Collapse c = collapse(worker(), 1, 0.4);
  figure("collapse: runout", GetParam(), "hertz", 1, c.runout, lube);
  figure("heap: weight on the floor", GetParam(), "hertz", 1, c.weight_on_floor, 1);
  figure("heap: wall and floor", GetParam(), "hertz", 1, c.wall_and_floor, 1);
  EXPECT_NEAR(c.runout, lube, 0.1 * lube);
  EXPECT_NEAR(c.weight_on_floor, 1, 0.01);
  EXPECT_NEAR(c.wall_and_floor, 1, 0.01);
}

TEST(Column, OfGrainsThatRollRunsFurther) {
  const Collapse c = collapse(worker_path("liggghts"), 0.5, 0.15);
  figure("collapse: runout at phi 27 deg", "liggghts", "hertz", 1, c.runout, lube);
  EXPECT_GT(c.runout, 1.1 * lube);
}

namespace {

// [kg/s/m] through a slot in the floor from 0.08 s, when it flows, to `end`, before the surface comes near.
double discharge(const std::string& worker, const std::string& folder, const Packing& packing, double slot, double length,
                 double height, double end = 0.25) {
  EngineSetup setup = channel(folder, length, height + 8 * d);
  const double middle = 0.5 * length, half = 0.5 * slot;
  setup.surfaces = {level("left floor", 0, middle - half), level("right floor", middle + half, length),
                    upright("left", 0, height + 4 * d, 0.5), upright("right", length, height + 4 * d, 0.5)};
  WorkerEngine engine(worker);
  engine.start(setup);
  AdvanceRequest request = steps(100);
  request.insert = at_rest(packing);
  double fallen = 0, time = 0, m0 = 0, t0 = 0;
  while (time < end) {
    const Advanced a = engine.advance(request);
    time += 100 * setup.timestep;
    request.insert.clear();
    request.remove.clear();
    for (std::size_t i = 0; i < a.grains.size(); ++i) {
      if (a.grains.z[i] > -2 * d) continue;
      request.remove.push_back(a.grains.id[i]);
      fallen += mass(a.grains.radius[i]);
    }
    if (time < 0.08) m0 = fallen, t0 = time;
  }
  return (fallen - m0) / (time - t0) / periodic_width;
}

}  // namespace

// Beverloo's law of a slot: mass per time and width W = C rho_b sqrt(g) (D - k d)^1.5, C about 1.03. So W^(2/3) is a line in D,
// which tells C and k.
TEST(Silo, RunsOutByBeverloo) {
  Folder folder;
  const double length = 20 * d, height = 20 * d;
  const Packing packing = block(length - 1.1 * d, height, folder.path);
  const double scale = packing.solid_fraction * density * std::sqrt(g);
  const std::vector<double> slots{5.0, 6.5, 8.0};
  std::vector<double> line;
  for (const double slot : slots) {
    const double rate = discharge(worker_path("liggghts"), folder.path, packing, slot * d, length, height);
    figure("silo: rate [kg/s/m]", "liggghts", "hertz", slot, rate, 1.03 * scale * std::pow((slot - 1.4) * d, 1.5));
    line.push_back(std::pow(rate / scale, 2.0 / 3) / d);
  }
  const double slope = (line[2] - line[0]) / (slots[2] - slots[0]), k = slots[0] - line[0] / slope;
  figure("silo: C", "liggghts", "hertz", 0, std::pow(slope, 1.5), 1.03);
  figure("silo: k", "liggghts", "hertz", 0, k, 1.4);
  EXPECT_NEAR(std::pow(slope, 1.5), 1.03, 0.15);
  EXPECT_NEAR(line[1], slope * (slots[1] - k), 0.05 * line[1]) << "on the line";
}

// One slot, a lower silo, a shorter time: YADE takes eight times as long.
TEST(Silo, RunsOutInYade) {
  Folder folder;
  const double length = 20 * d, height = 13 * d, slot = 6.5 * d;
  Packing packing = block(length - 1.1 * d, 20 * d, folder.path);
  cut_off(packing, height);
  const double rate = discharge(worker_path("yade"), folder.path, packing, slot, length, height, 0.15);
  const double law = 1.03 * packing.solid_fraction * density * std::sqrt(g) * std::pow(slot - 1.4 * d, 1.5);
  figure("silo: rate in 0.07 s [kg/s/m]", "yade", "hertz", 6.5, rate, law);
  EXPECT_NEAR(rate, law, 0.3 * law);
}
