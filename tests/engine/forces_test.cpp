// Forces on surfaces against the weight, and the book of momentum.
#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

namespace {

Vec sum(const std::vector<Vec>& forces) {
  Vec total{};
  for (const Vec& f : forces) {
    for (int k = 0; k < 3; ++k) total[k] += f[k];
  }
  return total;
}

}  // namespace

struct SurfaceForces : OnEngine {};
struct Momentum : OnEngine {};

INSTANTIATE_TEST_SUITE_P(On, SurfaceForces, engines, name_of_engine);
INSTANTIATE_TEST_SUITE_P(On, Momentum, engines, name_of_engine);

TEST_P(SurfaceForces, OfSettledGrainsSumToTheWeightAlsoWhenTilted) {
  for (const double tilt : {0.0, 45.0}) {
    Folder folder;
    EngineSetup setup = box(folder.path);
    const double a = tilt * std::numbers::pi / 180;
    setup.gravity = {g * std::sin(a), 0, -g * std::cos(a)};
    WorkerEngine engine(worker());
    engine.start(setup);
    AdvanceRequest request = steps(10000);
    request.insert = lattice(8, 6);
    const Advanced settled = engine.advance(request);
    EXPECT_LT(settled.max_overlap, 0.05);
    EXPECT_GT(settled.max_overlap, 0.0);
    const Advanced mean = engine.advance(steps(2000));
    const double weight = mass(mean.grains) * g;
    const Vec force = sum(mean.surface_force);
    EXPECT_NEAR(force[0], weight * std::sin(a), 0.01 * weight) << "tilt " << tilt;
    EXPECT_NEAR(force[1], 0, 0.01 * weight);
    EXPECT_NEAR(force[2], -weight * std::cos(a), 0.01 * weight);
    if (tilt == 0) {
      EXPECT_LT(mean.surface_force[0][2], -0.5 * weight);  // most rests on the floor
    } else {
      EXPECT_GT(mean.surface_force[2][0], 0.2 * weight);  // the lower wall holds
      EXPECT_NEAR(mean.surface_force[1][0], 0, 0.02 * weight);
    }
  }
}

// A slab that slides along a periodic box: it goes round several times, and comes back into the box.
TEST_P(SurfaceForces, AndMomentumInAPeriodicBox) {
  Folder folder;
  const double w = 8 * 1.12 * d;
  EngineSetup setup = box(folder.path);
  setup.gravity = {0.6 * g, 0.1 * g, -g};
  setup.lo = {-0.3 * w, 0.1 * w, -d};
  setup.hi = {0.7 * w, 1.1 * w, 0.08};
  setup.periodic = {true, true, false};
  setup.surfaces = {{"floor", rectangle({-0.3 * w, 0.1 * w, 0}, {w, 0, 0}, {0, w, 0}), 0.2, 0.15}};
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(2000);
  request.insert = lattice(8, 3);
  for (NewGrain& n : request.insert) {  // already under way, and laid over the box's sides
    n.position[0] -= 0.3 * w;
    n.position[1] += 0.1 * w;
    n.velocity[0] += 3;
  }
  Advanced before = engine.advance(request);
  double worst = 0, way = 0;
  for (int window = 0; window < 20; ++window) {
    const Advanced a = engine.advance(steps(150));
    const double time = 150 * setup.timestep, m = mass(a.grains);
    const Vec p0 = momentum(before.grains), p1 = momentum(a.grains), force = sum(a.surface_force);
    for (int k = 0; k < 3; ++k)
      worst = std::max(worst, std::abs(p1[k] - p0[k] - (m * setup.gravity[k] - force[k]) * time) / (m * g * time));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a.zone_force[k], -force[k], 1e-9 * m * g) << "without faces the zone is all";
    way += time * p1[0] / m;
    for (std::size_t i = 0; i < a.grains.size(); ++i) {
      ASSERT_TRUE(a.grains.x[i] >= setup.lo[0] && a.grains.x[i] <= setup.hi[0]) << a.grains.x[i];
      ASSERT_TRUE(a.grains.y[i] >= setup.lo[1] && a.grains.y[i] <= setup.hi[1]) << a.grains.y[i];
    }
    EXPECT_LT(a.max_overlap, 0.05);
    before = a;
  }
  EXPECT_EQ(before.grains.size(), 192u);
  EXPECT_GT(way, 3 * w);
  EXPECT_LT(worst, 1e-9);
}

// Samples are part of no engine's motion, and a window's forces in parts.
TEST_P(SurfaceForces, InSamplesAverageToTheMean) {
  for (const int ranks : OnEngine::ranks()) {
    Folder folder, other;
    EngineSetup setup = box(folder.path), same = box(other.path);
    setup.ranks = same.ranks = ranks;
    WorkerEngine engine(worker()), plain(worker());
    engine.start(setup);
    plain.start(same);
    AdvanceRequest request = steps(300);  // into the impact
    request.insert = lattice(8, 3);
    plain.advance(request);
    request.sample_steps = 75;
    EXPECT_EQ(engine.advance(request).surface_force_samples.at(0).size(), 4u);
    double worst = 0, spread = 0, largest = 0;
    for (int window = 0; window < 20; ++window) {
      AdvanceRequest sampled = steps(40);
      sampled.sample_steps = 5;
      const Advanced a = engine.advance(sampled), b = plain.advance(steps(40));
      ASSERT_TRUE(same_bits(a.grains, b.grains)) << window;
      ASSERT_EQ(a.surface_force, b.surface_force);
      EXPECT_TRUE(b.surface_force_samples.empty() || b.surface_force_samples[0].empty());
      ASSERT_EQ(a.surface_force_samples.size(), 5u);
      for (std::size_t s = 0; s < 5; ++s) {
        ASSERT_EQ(a.surface_force_samples[s].size(), 8u);
        for (int k = 0; k < 3; ++k) {
          double sum = 0;
          for (const Vec& sample : a.surface_force_samples[s]) {
            sum += sample[k] / 8;
            spread = std::max(spread, std::abs(sample[k] - a.surface_force[s][k]));
            largest = std::max(largest, std::abs(sample[k]));
          }
          worst = std::max(worst, std::abs(sum - a.surface_force[s][k]));
        }
      }
    }
    EXPECT_LT(worst, 1e-13 * largest) << ranks << " ranks";
    EXPECT_GT(spread, 0.01 * largest);  // within a window forces do change
    AdvanceRequest uneven = steps(17);
    uneven.sample_steps = 5;
    EXPECT_EQ(engine.advance(uneven).surface_force_samples[0].size(), 3u);
    uneven.sample_steps = -1;
    EXPECT_NE(error_of([&] { engine.advance(uneven); }).find("a mean over -1 steps is not possible"), std::string::npos);
  }
}

// P1 - P0 = gravity + surfaces + driving + inserted - removed, window by window, with everything going on at once, checkpoints
// included.
TEST_P(Momentum, IsBookedExactly) {
  for (const int ranks : OnEngine::ranks()) {
    Folder folder;
    EngineSetup setup = box(folder.path);
    setup.ranks = ranks;
    setup.gravity = {3, 1, -g};
    const double w = 8 * 1.12 * d;
    DriveFace face;
    face.origin = {0.3 * w, 0, 0};
    face.inward = {1, 0, 0};
    face.along = {0, 1, 0};
    face.segment_width = w / 2;
    face.segments = 2;
    face.strip_begin = 0.1 * w;
    face.strip_end = 0.2 * w;
    setup.faces = {face};
    WorkerEngine engine(worker());
    engine.start(setup);
    const std::vector<NewGrain> all = lattice(8, 6);
    Grains before;
    std::int64_t next = 0;
    double worst = 0;
    for (int window = 0; window < 40; ++window) {
      AdvanceRequest request = steps(37);
      Vec p{};
      if (window % 10 == 7) {  // the rim moves; every other grain outside of it is driven from now on
        face.origin[0] += window % 20 == 7 ? -0.15 * w : 0.15 * w;
        RimMove move{{face}, {}};
        for (std::size_t i = 0; i < before.size(); i += 2)
          if (before.x[i] < face.origin[0]) move.driven.push_back({before.id[i], 0, before.y[i] < w / 2 ? 0 : 1});
        EXPECT_FALSE(move.driven.empty());
        request.rim_moves = {move};
      }
      for (int n = 0; n < 10 && next < static_cast<std::int64_t>(all.size()); ++n, ++next) {
        NewGrain grain = all[static_cast<std::size_t>(next)];
        if (grain.position[0] < face.origin[0] - 0.6 * d) {
          grain.face = 0;
          grain.segment = grain.position[1] < w / 2 ? 0 : 1;
        }
        for (int k = 0; k < 3; ++k) p[k] += mass(grain.radius) * grain.velocity[k];
        request.insert.push_back(grain);
      }
      for (std::size_t i = 0; i < before.size(); i += 9) {
        if (window % 5 != 4) break;
        request.remove.push_back(before.id[i]);
        const double m = mass(before.radius[i]);
        p[0] -= m * before.vx[i];
        p[1] -= m * before.vy[i];
        p[2] -= m * before.vz[i];
      }
      SegmentDrive drive{0.001, 0.3 + 0.01 * (window % 7), -0.1, 0.05, 1e-4, window % 3 == 0, {-0.2, 0.1, 0}};
      request.drives = {{drive, drive}};
      const Advanced a = engine.advance(request);
      const Vec p0 = momentum(before), p1 = momentum(a.grains), surfaces = sum(a.surface_force);
      const double time = 37 * setup.timestep, m = mass(a.grains);
      double scale = m * g * time;
      for (int k = 0; k < 3; ++k) {
        const double residual = p1[k] - p0[k] - p[k] - (m * setup.gravity[k] * time - surfaces[k] * time + a.drive_impulse[k]);
        worst = std::max(worst, std::abs(residual) / scale);
      }
      before = a.grains;
      if (window % 8 == 6) engine.checkpoint(folder.path + "/state");
    }
    EXPECT_LT(worst, 1e-9) << ranks << " ranks";
    RecordProperty("worst_" + std::to_string(ranks), std::to_string(worst));
    std::printf("largest residual over weight impulse: %.3g (%d ranks)\n", worst, ranks);
  }
}
