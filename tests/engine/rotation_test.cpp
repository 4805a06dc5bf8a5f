// Blocked rotation and rotation control (4.11)-(4.13), on single grains whose spin is known from their energy.
#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

struct RotationRule : OnEngine {};

INSTANTIATE_TEST_SUITE_P(On, RotationRule, engines, name_of_engine);

namespace {

// Smooth, so that contacts turn nothing: what slows a spin is the rule alone.
EngineSetup smooth(const std::string& folder, const RotationControl& control) {
  EngineSetup s = box(folder);
  s.friction = s.rolling_friction = 0;
  for (EngineSurface& surface : s.surfaces) surface.friction = surface.rolling_friction = 0;
  s.rotation = Rotation::control;
  s.control = control;
  return s;
}

// [m] overlap at which the floor carries a grain; Hertz.
double resting_overlap() {
  const double modulus = 5e6 / (2 * (1 - 0.25 * 0.25));
  return std::pow(0.75 * mass(r) * g / (modulus * std::sqrt(r)), 2.0 / 3);
}

NewGrain spinning(std::int64_t id, Vec position, Vec velocity, double spin) {
  NewGrain n;
  n.id = id;
  n.position = position;
  n.velocity = velocity;
  n.radius = r;
  n.spin = {0, 0, spin};
  return n;
}

double spin_after(const std::string& worker, const EngineSetup& setup, const NewGrain& grain, double time) {
  WorkerEngine engine(worker);
  engine.start(setup);
  AdvanceRequest request = steps(std::llround(time / setup.timestep));
  request.insert = {grain};
  return spin_of(engine.advance(request));
}

}  // namespace

TEST_P(RotationRule, SlowsASpinWhateverTheTimeStep) {
  RotationControl control;
  control.retarding_time = 0.01;
  control.contact_influence = 1.5;
  for (const double share : {1.0, 0.5, 0.25}) {
    Folder folder;
    EngineSetup setup = smooth(folder.path, control);
    setup.timestep = 2e-5 * share;
    const double time = 0.02, w0 = 50;
    const double w = spin_after(worker(), setup, spinning(1, {4 * d, 4 * d, r - resting_overlap()}, {0, 0, 0}, w0), time);
    EXPECT_NEAR(w, w0 * 0.25, 1e-6 * w0) << "k = 1/2 of one contact, twice the retarding time; step " << setup.timestep;
  }
}

TEST_P(RotationRule, LeavesAGrainWithoutContactAlone) {
  for (const double influence : {0.0, 2.0}) {
    Folder folder;
    RotationControl control{1e-3, influence, 0, 0.5, 0.1};
    EXPECT_NEAR(spin_after(worker(), smooth(folder.path, control), spinning(1, {4 * d, 4 * d, 15 * d}, {0, 0, 0}, 40), 0.05), 40,
                1e-9);
  }
}

// Floor and two walls: three contacts. The walls are pushed against by tilted gravity.
TEST_P(RotationRule, CountsSurfacesAndTriangles) {
  RotationControl control;
  control.retarding_time = 0.01;
  control.contact_influence = 2;
  Folder folder;
  EngineSetup setup = smooth(folder.path, control);
  setup.gravity = {-g, -g, -g};
  setup.timestep = 2e-5;
  const double at = r - resting_overlap();
  const double w = spin_after(worker(), setup, spinning(1, {at, at, at}, {0, 0, 0}, 50), 0.01);
  EXPECT_NEAR(w, 50 * 0.1, 1e-4) << "k = 1 / (1 + 3^2); the floor's diagonal runs below the grain";
}

TEST_P(RotationRule, CountsGrains) {
  RotationControl control;
  control.retarding_time = 0.01;
  Folder folder;
  EngineSetup setup = smooth(folder.path, control);
  setup.gravity = {0, 0, 0};
  setup.timestep = 2e-5;
  setup.restitution = 1;
  setup.surfaces.clear();
  // A row of three, pressed together so little that they part only later; the middle one has two contacts.
  const double gap = d * (1 - 1e-4);
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(1);
  request.insert = {spinning(1, {4 * d - gap, 4 * d, 4 * d}, {0, 0, 0}, 0), spinning(2, {4 * d, 4 * d, 4 * d}, {0, 0, 0}, 50),
                    spinning(3, {4 * d + gap, 4 * d, 4 * d}, {0, 0, 0}, 0)};
  const int count = OnEngine::yade() ? 20 : 1;  // YADE looks every 20 steps
  request.steps = count;
  const Advanced a = engine.advance(request);
  double moving = 0;
  for (std::size_t i = 0; i < 3; ++i)
    moving += 0.5 * mass(r) * (a.grains.vx[i] * a.grains.vx[i] + a.grains.vy[i] * a.grains.vy[i]);
  const double w = std::sqrt((a.kinetic_energy - moving) * 2 / (0.4 * mass(r) * r * r));
  EXPECT_NEAR(w, 50 * std::pow(1.0 / 3, count * setup.timestep / 0.01), 1e-6);
}

// lambda = k_v v_s + lambda_c: a grain that slides along the floor keeps its spin for longer.
TEST_P(RotationRule, SlowsLessInShear) {
  RotationControl control;
  control.retarding_time = 0.01;
  control.shear_influence = 0.05;
  Folder folder;
  EngineSetup setup = smooth(folder.path, control);
  setup.timestep = 2e-5;
  const double v = 0.4, time = 0.02;
  // Beside the floor's diagonal: at a step or two on their edge a grain touches both triangles.
  const double w = spin_after(worker(), setup, spinning(1, {d, 6 * d, r - resting_overlap()}, {v, 0, 0}, 50), time);
  EXPECT_NEAR(w, 50 * std::pow(0.5, time / (0.05 * v + 0.01)), 1e-5);
}

// A rough floor would make each of them roll: 0.3 m/s and above v_sr does, 0.1 m/s slides on; and rolling ends below v_rs.
TEST_P(RotationRule, HasThresholdsForSlidingAndRolling) {
  RotationControl control;
  control.retarding_time = 1e6;  // slows nothing in this time
  control.slide_to_roll = 0.2;
  control.roll_to_slide = 0.05;
  const auto run = [&](double speed, double spin, double time, double friction) {
    Folder folder;
    EngineSetup setup = smooth(folder.path, control);
    setup.timestep = 2e-5;
    setup.surfaces[0].friction = friction;
    NewGrain grain = spinning(1, {d, 6 * d, r - resting_overlap()}, {speed, 0, 0}, spin);
    return spin_after(worker(), setup, grain, time);
  };
  EXPECT_EQ(run(0.1, 0, 0.01, 0.3), 0) << "below v_sr: slides";
  EXPECT_NEAR(run(0.3, 0, 0.005, 0.3), 2.5 * 0.3 * g * 0.005 / r, OnEngine::yade() ? 4.0 : 0.5) << "above: friction turns it";
  EXPECT_NEAR(run(0.1, 30, 0.01, 0), 30, 1e-6) << "it spins already, and is above v_rs";
  EXPECT_EQ(run(0.04, 30, 0.01, 0), 0) << "it spins, but below v_rs";
}

TEST_P(RotationRule, BlockedGrainsDoNotTurn) {
  Folder folder;
  EngineSetup setup = box(folder.path);
  setup.rotation = Rotation::blocked;
  setup.gravity = {0.3 * g, 0, -g};
  for (EngineSurface& surface : setup.surfaces) surface.rolling_friction = 0;
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(500);
  request.insert = lattice(8, 3);
  for (NewGrain& n : request.insert) n.spin = {20, -10, 5};
  for (int window = 0; window < 4; ++window) {
    const Advanced a = engine.advance(request);
    request.insert.clear();
    double moving = 0;
    for (std::size_t i = 0; i < a.grains.size(); ++i) {
      moving += 0.5 * mass(a.grains.radius[i]) *
                (a.grains.vx[i] * a.grains.vx[i] + a.grains.vy[i] * a.grains.vy[i] + a.grains.vz[i] * a.grains.vz[i]);
    }
    EXPECT_NEAR(a.kinetic_energy, moving, 1e-12 * moving);
    if (window == 1) engine.checkpoint(folder.path + "/state");
  }
}

// The bits after a checkpoint are those of the run that wrote it.
TEST_P(RotationRule, GoesOnFromACheckpoint) {
  for (const int ranks : OnEngine::ranks()) {
    Folder folder;
    EngineSetup setup = box(folder.path);
    setup.ranks = ranks;
    setup.rotation = Rotation::control;
    setup.control = {2e-3, 1, 0.01, 0.05, 0.01};
    const std::string state = folder.path + "/state";
    Grains went_on;
    {
      WorkerEngine engine(worker());
      engine.start(setup);
      AdvanceRequest request = steps(700);
      request.insert = lattice(8, 3);
      engine.advance(request);
      engine.checkpoint(state);
      went_on = engine.advance(steps(400)).grains;
    }
    WorkerEngine engine(worker());
    engine.restore(setup, state);
    EXPECT_TRUE(same_bits(engine.advance(steps(400)).grains, went_on)) << ranks << " ranks";
  }
}

TEST(RotationRules, HaveNames) {
  for (const Rotation rule : {Rotation::free, Rotation::blocked, Rotation::control}) EXPECT_EQ(rotation(to_string(rule)), rule);
  EXPECT_THROW(rotation("damped"), std::invalid_argument);
}
