// Rafts and exit strips.
#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

namespace {

constexpr double width = 8 * 1.12 * d;

// A channel along x with a floor and sides; the face at x = 0, and at `wall` the end, if positive.
EngineSetup channel(const std::string& folder, double wall, int segments = 1) {
  EngineSetup s = box(folder);
  const double x0 = -0.06, x1 = 0.12, h = 0.06;
  s.lo = {x0, -d, -d};
  s.hi = {x1, width + d, h};
  s.surfaces = {{"floor", rectangle({x0, 0, 0}, {x1 - x0, 0, 0}, {0, width, 0}), 0.2, 0.15},
                {"left", rectangle({x0, 0, 0}, {x1 - x0, 0, 0}, {0, 0, h}), 0.0, 0.15},
                {"right", rectangle({x0, width, 0}, {x1 - x0, 0, 0}, {0, 0, h}), 0.0, 0.15}};
  if (wall > 0) s.surfaces.push_back({"wall", rectangle({wall, 0, 0}, {0, width, 0}, {0, 0, h}), 0.5, 0.15});
  s.faces = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, width / segments, segments, 2 * d, 5 * d}};
  return s;
}

// Three layers deep, as many columns long as asked for, its front at x = -front.
std::vector<NewGrain> layer(int columns, double front, double speed, std::int64_t first_id, int segments = 1) {
  std::vector<NewGrain> grains;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < 8; ++j) {
      for (int k = 0; k < 3; ++k) {
        NewGrain n;
        n.id = first_id + static_cast<std::int64_t>(grains.size());
        n.position = {-front - i * 1.05 * d, (j + 0.5) * 1.12 * d, (0.5 + k * 1.0) * d};
        n.velocity = {speed, 0, 0};
        n.radius = 0.5 * d;
        n.face = 0;
        n.segment = std::min(segments - 1, j * segments / 8);
        grains.push_back(n);
      }
    }
  }
  return grains;
}

}  // namespace

struct Raft : OnEngine {};
struct Strip : OnEngine {};

INSTANTIATE_TEST_SUITE_P(On, Raft, engines, name_of_engine);
INSTANTIATE_TEST_SUITE_P(On, Strip, engines, name_of_engine);

TEST_P(Raft, EntersAtItsMostAndIsFreeBeyondThePlane) {
  Folder folder;
  const EngineSetup setup = channel(folder.path, 0);
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(100);
  request.insert = layer(2, 0.5 * d, 0.5, 1);
  request.drives = {{{10, 0.5, -0.1, 0.0, 1e-6, false, {}}}};
  Advanced a = engine.advance(request);
  double moved = a.segments[0][0].displacement;
  EXPECT_NEAR(moved, 100 * setup.timestep * 0.5, 1e-15);
  EXPECT_EQ(a.segments[0][0].velocity, 0.5);
  ASSERT_EQ(a.grains.size(), 48u);
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    EXPECT_NEAR(a.grains.x[i], request.insert[i].position[0] + moved, 1e-15) << "a driven grain moves as its raft did";
    EXPECT_EQ(a.grains.vx[i], 0.5);
    EXPECT_EQ(a.grains.vz[i], 0.0);
    EXPECT_EQ(a.grains.driven[i], 1);
  }
  EXPECT_NEAR(a.segments[0][0].mass, mass(a.grains), 1e-15);
  const AdvanceRequest on = steps(50);  // drives as before
  double x_front_release = -1;
  for (int n = 0; n < 40 && a.segments[0][0].mass > 0; ++n) {
    a = engine.advance(on);
    moved += a.segments[0][0].displacement;
    for (std::size_t i = 0; i < a.grains.size(); ++i) {
      EXPECT_TRUE(!a.grains.driven[i] || a.grains.x[i] < 0);
      if (!a.grains.driven[i] && x_front_release < 0) x_front_release = a.grains.x[i];
    }
  }
  EXPECT_EQ(a.segments[0][0].mass, 0) << "all released";
  EXPECT_GE(x_front_release, 0);
  EXPECT_LT(x_front_release, 51 * setup.timestep * 0.5) << "released at once";
  EXPECT_EQ(a.segments[0][0].velocity, 0.5) << "with no grains it moves at its most";
}

TEST_P(Raft, ReleasedGrainsStayFreeWhenTheyComeBack) {
  Folder folder;
  EngineSetup setup = channel(folder.path, 0);
  setup.gravity = {-40, 0, -g};  // pushes them back out
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(1);
  request.insert = layer(1, 0.1 * d, 0.3, 1);
  request.drives = {{{0, 0.3, 0.3, 0.0, 0, false, {}}}};
  engine.advance(request);
  bool came_back = false;
  for (int n = 0; n < 60 && !came_back; ++n) {
    const Advanced a = engine.advance(steps(20));
    for (std::size_t i = 0; i < a.grains.size(); ++i) came_back = came_back || (a.grains.x[i] < -0.5 * d && !a.grains.driven[i]);
  }
  EXPECT_TRUE(came_back);
}

TEST_P(Raft, SegmentsMoveApart) {
  Folder folder;
  const EngineSetup setup = channel(folder.path, 0, 2);
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(200);
  request.insert = layer(1, 3 * d, 0.2, 1, 2);
  request.drives = {{{1, 0.2, 0.2, 0.0, 0, false, {}}, {1, 0.1, 0.1, 0.01, 0, false, {}}}};
  const Advanced a = engine.advance(request);
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    EXPECT_EQ(a.grains.vx[i], request.insert[i].segment == 0 ? 0.2 : 0.1);
    EXPECT_EQ(a.grains.vy[i], 0) << "a layer keeps its packing";
  }
  EXPECT_NEAR(a.segments[0][0].displacement, 2 * a.segments[0][1].displacement, 1e-15);
}

TEST_P(Raft, AFreedGrainTakesTheVelocityAlongTheFace) {
  Folder folder;
  EngineSetup setup = channel(folder.path, 0);
  setup.gravity = {0, 0, 0};
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(1);
  request.insert = {{1, {-0.01 * d, 2 * d, 2 * d}, {0.2, 0, 0}, 0.5 * d, 0, 0}};
  request.drives = {{{1, 0.2, 0.2, 0.03, 0, false, {}}}};
  engine.advance(request);
  const Advanced a = engine.advance(steps(20));
  ASSERT_EQ(a.grains.size(), 1u);
  EXPECT_FALSE(a.grains.driven[0]);
  EXPECT_DOUBLE_EQ(a.grains.vx[0], 0.2);
  EXPECT_DOUBLE_EQ(a.grains.vy[0], 0.03);
}

// Along the face a layer slides as one; what has slid into another segment goes on with that one's raft.
TEST_P(Raft, SlidesAlongItsFaceAndIsTakenOverByTheNextSegment) {
  Folder folder;
  EngineSetup setup = channel(folder.path, 0, 2);
  setup.gravity = {0, 0, 0};
  WorkerEngine engine(worker());
  engine.start(setup);
  const double slide = 0.1, first = 0.1, second = 0.15, along = 0.03;
  AdvanceRequest request = steps(1);
  const double y = width / 2 - 0.2 * d;
  request.insert = {{1, {-3 * d, y, 2 * d}, {first, slide, 0}, 0.5 * d, 0, 0}};
  request.drives = {{{1, first, first, along, 0, false, {}, slide}, {1, second, second, along, 0, false, {}, slide}}};
  engine.advance(request);
  const auto weight = mass(0.5 * d);
  const int to_cross = int(0.3 * d / slide / setup.timestep);
  Advanced a = engine.advance(steps(to_cross));
  EXPECT_NEAR(a.grains.y[0], y + (to_cross + 1) * setup.timestep * slide, 1e-15);
  EXPECT_NEAR(a.grains.x[0], -3 * d + (to_cross + 1) * setup.timestep * first, 1e-15);
  EXPECT_EQ(a.grains.vx[0], first) << "until the next advance";
  EXPECT_NEAR(a.drive_impulse[0], 0, 1e-15);

  a = engine.advance(steps(10));
  EXPECT_EQ(a.grains.vx[0], second);
  EXPECT_EQ(a.grains.vy[0], slide);
  EXPECT_NEAR(a.segments[0][1].mass, weight, 1e-15);
  EXPECT_EQ(a.segments[0][0].mass, 0);
  EXPECT_NEAR(a.drive_impulse[0], weight * (second - first), 1e-15);
  EXPECT_NEAR(a.drive_impulse[1], 0, 1e-15);

  a = engine.advance(steps(int(4 * d / second / setup.timestep)));
  EXPECT_FALSE(a.grains.driven[0]);
  EXPECT_DOUBLE_EQ(a.grains.vx[0], second);
  EXPECT_DOUBLE_EQ(a.grains.vy[0], along);
  EXPECT_NEAR(a.drive_impulse[1], weight * (along - slide), 1e-15);
}

// Beside an arc it turns about the arc's axis: it keeps its height above the bed, and its speed is that of a rigid body.
TEST_P(Raft, TurnsWithItsFaceBesideAnArc) {
  Folder folder;
  const double radius = 0.04, turn = 0.9, high = 1.5 * d, slide = 0.2;
  EngineSetup setup = channel(folder.path, 0);
  setup.gravity = {0, 0, 0};
  setup.hi = {0.12, width + d, 0.12};
  setup.surfaces = {{"far", rectangle({-0.06, width, 0}, {0.18, 0, 0}, {0, 0, 0.12}), 0.2, 0.15}};
  // The bed: level to x = 0, then up about the axis through (0, 0.04).
  setup.faces = {{.origin = {-0.03, 0, 0},
                  .inward = {0, 1, 0},
                  .along = {1, 0, 0},
                  .segment_width = 0.1,
                  .segments = 1,
                  .strip_begin = 2 * d,
                  .strip_end = 5 * d,
                  .bend = {.begin = 0.03, .length = radius * turn, .foot = {0, 0, 0}, .centre = {0, 0, radius}}}};
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(1);
  request.insert = {{1, {-0.02, -d, high}, {slide, 0, 0}, 0.5 * d, 0, 0}};
  request.drives = {{{0, 0, 0, 0, 0, false, {}, slide}}};
  Advanced a = engine.advance(request);
  EXPECT_NEAR(a.grains.vz[0], 0, 1e-15);
  const double m = mass(0.5 * d), arm = radius - high;
  Vec before{a.grains.vx[0], a.grains.vy[0], a.grains.vz[0]};
  const auto go = [&](double time) {
    a = engine.advance(steps(int(std::lround(time / setup.timestep))));
    EXPECT_NEAR(a.drive_impulse[0], m * (a.grains.vx[0] - before[0]), 1e-12 * m);
    EXPECT_NEAR(a.drive_impulse[2], m * (a.grains.vz[0] - before[2]), 1e-12 * m);
    before = {a.grains.vx[0], a.grains.vy[0], a.grains.vz[0]};
  };
  go(0.02 / slide);
  go(0.5 * turn * radius / slide);
  const double turned = std::atan2(a.grains.x[0], radius - a.grains.z[0]);
  EXPECT_NEAR(turned, 0.5 * turn, 0.01);
  EXPECT_NEAR(std::hypot(a.grains.x[0], radius - a.grains.z[0]), arm, 1e-3 * arm);
  EXPECT_NEAR(a.grains.vx[0], slide * arm / radius * std::cos(turned), 1e-3 * slide);
  EXPECT_NEAR(a.grains.vz[0], slide * arm / radius * std::sin(turned), 1e-3 * slide);
  EXPECT_EQ(a.grains.vy[0], 0);

  go((0.5 * turn * radius + 0.01) / slide);  // 10 mm on the straight behind
  const Vec end{radius * std::sin(turn), 0, radius * (1 - std::cos(turn))};
  const Vec from_end{a.grains.x[0] - end[0], 0, a.grains.z[0] - end[2]};
  EXPECT_NEAR(from_end[0] * std::cos(turn) + from_end[2] * std::sin(turn), 0.01, 3e-4);
  EXPECT_NEAR(-from_end[0] * std::sin(turn) + from_end[2] * std::cos(turn), high, 1e-3 * arm);
  EXPECT_NEAR(a.grains.vz[0], slide * std::sin(turn), 1e-12);

  // What is let go goes on along the bed, as fast as it is told at any height: one here, another on the arc.
  request = steps(1);
  const double there = 0.4 * turn, along = 0.05;
  request.insert = {{2, {arm * std::sin(there), -0.01 * d, radius - arm * std::cos(there)}, {0, 0, 0}, 0.5 * d, 0, 0}};
  request.drives = {{{0, 0.1, 0.1, along, 0, false, {}, slide}}};
  engine.advance(request);
  a = engine.advance(steps(int(1.2 * d / 0.1 / setup.timestep)));
  EXPECT_FALSE(a.grains.driven[0]);
  EXPECT_NEAR(a.grains.vx[0], along * std::cos(turn), 1e-12);
  EXPECT_NEAR(a.grains.vz[0], along * std::sin(turn), 1e-12);
  EXPECT_NEAR(a.grains.vy[0], 0.1, 1e-12);
  EXPECT_FALSE(a.grains.driven[1]);
  EXPECT_NEAR(std::hypot(a.grains.vx[1], a.grains.vz[1]), along, 1e-12);
  EXPECT_NEAR(std::atan2(a.grains.vz[1], a.grains.vx[1]), there, 0.02);
}

// Grains stand jammed between the face and a wall: a raft with a finite push must stop, one with imposed velocity would not.
TEST_P(Raft, IsStoppedByGrainsInItsWay) {
  Folder folder;
  const EngineSetup setup = channel(folder.path, 5 * 1.05 * d);
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(1);
  request.insert = layer(8, 0, 0.3, 1);
  double weight = 0;
  for (NewGrain& n : request.insert) {
    n.position[0] += 4.5 * 1.05 * d;
    if (n.position[0] >= -0.2 * d) n.face = n.segment = -1;
    weight += mass(n.radius) * g;
  }
  const double push = 0.1 * weight;
  request.drives = {{{push, 0.3, -0.02, 0.0, 1e-6, false, {}}}};
  Advanced a = engine.advance(request);
  for (int n = 0; n < 60; ++n) a = engine.advance(steps(200));
  EXPECT_GT(a.segments[0][0].mass, 0);
  EXPECT_LT(std::abs(a.segments[0][0].velocity), 0.03);
  EXPECT_NEAR(a.segments[0][0].force, -push, 0.5 * push) << "the grains hold against the push";
  EXPECT_LT(a.max_overlap, 0.05) << "no piston";
}

TEST_P(Strip, FreeGrainsLeaveAtTheExitVelocity) {
  Folder folder;
  const EngineSetup setup = channel(folder.path, 0);
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(50);
  request.insert = layer(4, 1 * d, 0, 1);
  for (NewGrain& n : request.insert) n.face = n.segment = -1;
  const Vec exit = {-0.25, 0.05, 0};
  request.drives = {{{0, 0, 0, 0.0, 0, true, exit}}};
  const Advanced a = engine.advance(request);
  int inside = 0, outside = 0;
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    if (a.grains.x[i] > -5 * d + 1e-4 && a.grains.x[i] < -2 * d - 1e-4) {
      EXPECT_EQ((Vec{a.grains.vx[i], a.grains.vy[i], a.grains.vz[i]}), exit);
      ++inside;
    } else if (a.grains.x[i] > -1.5 * d) {
      EXPECT_GT(a.grains.vx[i], -0.2);
      ++outside;
    }
    EXPECT_EQ(a.grains.driven[i], 0);
  }
  EXPECT_GE(inside, 40);
  EXPECT_GE(outside, 20);
}

// The rim moves up: what was driven is free, what is named is driven by the new raft, which starts with its grains' mean
// velocity.
TEST_P(Raft, GoesOnBehindARimThatMoved) {
  Folder folder;
  const EngineSetup setup = channel(folder.path, 0);
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(40);
  request.insert = layer(4, 0.5 * d, 0.3, 1);
  for (NewGrain& n : request.insert)
    if (n.position[0] < -2 * 1.05 * d) n.face = n.segment = -1;  // the last columns come by themselves
  request.drives = {{{0, 0.3, 0.3, 0.0, 0, false, {}}}};
  const Advanced before = engine.advance(request);

  AdvanceRequest move = steps(40);
  RimMove to{setup.faces, {}};
  to.faces[0].origin[0] = -2 * 1.05 * d;
  double momentum = 0, weight = 0;
  for (std::size_t i = 0; i < before.grains.size(); ++i) {
    if (before.grains.x[i] >= to.faces[0].origin[0]) continue;
    to.driven.push_back({before.grains.id[i], 0, 0});
    momentum += mass(before.grains.radius[i]) * before.grains.vx[i];
    weight += mass(before.grains.radius[i]);
  }
  ASSERT_GT(to.driven.size(), 5u);
  ASSERT_LT(to.driven.size(), before.grains.size());
  move.rim_moves = {to};
  move.drives = {{{0, 1.0, -1.0, 0.0, 0, false, {}}}};
  const Advanced after = engine.advance(move);
  EXPECT_NEAR(after.segments[0][0].mass, weight, 1e-12 * weight);
  const double start = momentum / weight;
  for (std::size_t i = 0; i < after.grains.size(); ++i) {
    const bool named =
        std::any_of(to.driven.begin(), to.driven.end(), [&](const Regrouped& g) { return g.id == after.grains.id[i]; });
    if (after.grains.driven[i]) {
      EXPECT_TRUE(named) << "grain " << after.grains.id[i];
    }
    if (named && after.grains.x[i] < to.faces[0].origin[0]) {
      EXPECT_TRUE(after.grains.driven[i]);
      EXPECT_NEAR(after.grains.x[i], before.grains.x[i] + after.segments[0][0].displacement, 1e-12);
    }
  }
  EXPECT_NEAR(after.segments[0][0].displacement, 40 * setup.timestep * start, 0.2 * 40 * setup.timestep * start);

  AdvanceRequest wrong = steps(1);
  wrong.rim_moves = {{setup.faces, {{4711, 0, 0}}}};
  wrong.drives = {{{0, 0, 0, 0.0, 0, false, {}}}};
  EXPECT_THROW(engine.advance(wrong), EngineError) << "an unknown grain";
}
