// Single grains on a plane and many in a box against closed solutions; both engines, both contact laws. Time steps are a tenth of
// what runs take, so that what differs is the law and not the step.
#include <algorithm>
#include <tuple>

#include "figures.hpp"
#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

namespace {

class Impact : public testing::TestWithParam<std::tuple<std::string, ContactLaw>> {
 public:
  static std::string engine() { return std::get<0>(GetParam()); }
  static std::string worker() { return worker_path(engine()); }
  static ContactLaw law() { return std::get<1>(GetParam()); }
  static void note(const char* check, double at, double measured, double theory) {
    figure(check, engine(), to_string(law()), at, measured, theory);
  }
};
INSTANTIATE_TEST_SUITE_P(On, Impact, testing::Combine(engines, testing::Values(ContactLaw::hertz, ContactLaw::kelvin_voigt)),
                         [](const auto& info) { return std::get<0>(info.param) + "_" + to_string(std::get<1>(info.param)); });

// A plane of two triangles; grains run along y = 0.03 m, which its diagonal crosses at x = 0.225 m.
EngineSetup plane(const std::string& folder, ContactLaw law, double restitution) {
  EngineSetup s = box(folder);
  s.contact = law;
  s.restitution = restitution;
  s.linear = linear_contact(stiffness, restitution);
  s.timestep = 0.1 * stable_timestep(law, stiffness);
  s.rolling_friction = 0;
  s.surfaces = {{"floor", rectangle({0, 0, 0}, {0.3, 0, 0}, {0, 0.04, 0}), 0.3, 0.0}};
  s.lo = {-d, -d, -d};
  s.hi = {0.3 + d, 0.04 + d, 0.08};
  return s;
}

NewGrain grain(double height, Vec velocity) {
  NewGrain n;
  n.id = 1;
  n.position = {0.01, 0.03, height};
  n.velocity = velocity;
  n.radius = r;
  return n;
}

// The grain after it has met the plane and left it.
Advanced rebound(const std::string& worker, const EngineSetup& setup, Vec velocity) {
  WorkerEngine engine(worker);
  engine.start(setup);
  AdvanceRequest request = steps(std::llround((0.1 * d / -velocity[2] + 4e-3) / setup.timestep));
  request.insert = {grain(r + 0.05 * d, velocity)};
  return engine.advance(request);
}

}  // namespace

// e = exp[-(b / s)(pi - p)], s = sqrt(1 - b^2), p = atan2(2 b s, 1 - 2 b^2), of a dashpot that never pulls.
TEST(LinearDashpot, ReboundsByItsDamping) {
  for (const char* name : {"liggghts", "yade"}) {
    for (const double b : {0.05, 0.1, 0.3}) {
      Folder folder;
      EngineSetup setup = plane(folder.path, ContactLaw::kelvin_voigt, 0.5);
      setup.gravity = {0, 0, 0};
      setup.linear.surface_damping = 2 * b * std::sqrt(mass(r) * setup.linear.stiffness);
      if (std::string(name) == "yade") setup.linear.damping = 4 * setup.linear.surface_damping;  // none of two grains' here
      const double s = std::sqrt(1 - b * b), p = std::atan2(2 * b * s, 1 - 2 * b * b);
      const double theory = std::exp(-b / s * (std::numbers::pi - p));
      const double e = rebound(worker_path(name), setup, {0, 0, -0.2}).grains.vz[0] / 0.2;
      figure("restitution by damping", name, "kelvin_voigt", b, e, theory);
      EXPECT_NEAR(e, theory, 0.005) << name << ", b = " << b;
    }
  }
}

namespace {

// [m/s] that a grain loses along the plane, by the linear law integrated finely and on its own: while the spring has not yet come
// to Coulomb's limit the damper pulls beside it, without any limit.
double speed_lost(const EngineSetup& s, double vx, double vn) {
  const LinearContact& c = s.linear;
  const double m = mass(r), mu = s.surfaces[0].friction, dt = 1e-9;
  double overlap = 0, in = vn, slip = vx, shear = 0, lost = 0;
  while (overlap >= 0) {
    const double normal = std::max(0.0, c.stiffness * overlap + c.surface_damping * in);
    shear += dt * slip;
    double along = c.shear_stiffness * shear + (s.tangential_damping ? c.surface_shear_damping : 0) * slip;
    if (c.shear_stiffness * shear > mu * normal) {
      along = mu * normal;
      shear = along / c.shear_stiffness;
    }
    in -= dt * normal / m;
    slip -= 3.5 * dt * along / m;  // 1 + 5/2 of a sphere
    lost += dt * along / m;
    overlap += dt * in;
  }
  return lost;
}

}  // namespace

// v_x' = v_x - mu (1 + e) v_n, w = (5/2) mu (1 + e) v_n / r while the whole contact slides; e as measured. So it is where
// contacts damp little. Else shear damping comes on top, in both engines and laws.
TEST_P(Impact, OfGrossSlidingReboundsWithItsFriction) {
  for (const double asked : {0.5, 0.9}) {
    Folder folder;
    EngineSetup setup = plane(folder.path, law(), asked);
    setup.gravity = {0, 0, 0};
    setup.timestep *= 0.2;
    const double vx = 1.5, vn = 0.2;
    const Advanced a = rebound(worker(), setup, {vx, 0, -vn});
    const double e = a.grains.vz[0] / vn, lost = vx - a.grains.vx[0], coulomb = 0.3 * (1 + e) * vn;
    note("restitution", asked, e, asked);
    note("gross sliding: speed lost", asked, lost, coulomb);
    note("gross sliding: spin", asked, spin_of(a), 2.5 * coulomb / r);
    EXPECT_NEAR(e, asked, 0.01);
    EXPECT_GT(lost, 0.99 * coulomb);
    EXPECT_NEAR(spin_of(a), 2.5 * lost / r, 0.015 * 2.5 * lost / r);
    if (asked == 0.9) {
      EXPECT_NEAR(lost, coulomb, 0.01 * coulomb);
    }
    if (law() == ContactLaw::kelvin_voigt) {
      const double twin = speed_lost(setup, vx, vn);
      note("sliding: linear law alone", asked, lost, twin);
      EXPECT_NEAR(lost, twin, 0.015 * twin);
    }
  }
}

// The same without the damper along the contact: Coulomb's law. What is left is the spring, which takes the contact's first
// moments to come to its limit: by the linear law alone 1.7 % less at a restitution of 0.3, 0.4 % at 0.5.
TEST_P(Impact, WithoutTangentialDampingReboundsAsCoulombSays) {
  for (const double asked : {0.3, 0.5, 0.9}) {
    Folder folder;
    EngineSetup setup = plane(folder.path, law(), asked);
    setup.tangential_damping = false;
    setup.gravity = {0, 0, 0};
    setup.timestep *= 0.2;
    const double vx = 1.5, vn = 0.2;
    const Advanced a = rebound(worker(), setup, {vx, 0, -vn});
    const double e = a.grains.vz[0] / vn, lost = vx - a.grains.vx[0], coulomb = 0.3 * (1 + e) * vn;
    note("undamped: restitution", asked, e, asked);
    note("undamped: speed lost", asked, lost, coulomb);
    note("undamped: spin", asked, spin_of(a), 2.5 * coulomb / r);
    EXPECT_NEAR(e, asked, 0.01);
    EXPECT_NEAR(lost, coulomb, (asked < 0.5 ? 0.02 : 0.01) * coulomb);
    EXPECT_NEAR(spin_of(a), 2.5 * lost / r, 0.015 * 2.5 * lost / r);
    if (law() == ContactLaw::kelvin_voigt) {
      const double twin = speed_lost(setup, vx, vn);
      EXPECT_NEAR(lost, twin, 0.005 * twin);
    }
  }
}

// u = u0 - mu g t down to 5 u0 / 7, where the grain rolls and keeps its speed.
TEST_P(Impact, SlipsUntilItRolls) {
  Folder folder;
  EngineSetup setup = plane(folder.path, law(), 0.5);
  setup.timestep *= 5;
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(std::llround(0.03 / setup.timestep));
  request.insert = {grain(r - 1e-6 * d, {0, 0, 0})};
  Advanced a = engine.advance(request);  // at rest on the floor: its height, for the one that slips
  const double height = a.grains.z[0], u0 = 0.4;
  request.steps = std::llround(2.5e-3 / setup.timestep);
  request.remove = {1};
  request.insert = {grain(height, {u0, 0, 0})};
  request.insert[0].id = 2;
  for (int n = 1; n <= 28; ++n) {
    a = engine.advance(request);
    request.insert.clear();
    request.remove.clear();
    const double t = n * static_cast<double>(request.steps) * setup.timestep;
    const double theory = std::max(u0 - 0.3 * g * t, 5.0 / 7 * u0);
    note("slip to roll: speed", t, a.grains.vx[0], theory);
    EXPECT_NEAR(a.grains.vx[0], theory, 0.01 * u0) << "after " << t << " s";
  }
  EXPECT_NEAR(a.grains.vx[0], 5.0 / 7 * u0, 0.003 * u0);
  EXPECT_NEAR(spin_of(a) * r, a.grains.vx[0], 0.003 * u0) << "it rolls";
}

// v = (5/7) g (sin a - mu_r cos a) t; kelvin_voigt has no rolling friction.
TEST_P(Impact, RollsDownAnIncline) {
  for (const double degrees : {4.0, 8.0, 12.0}) {
    Folder folder;
    EngineSetup setup = plane(folder.path, law(), 0.5);
    const double slope = degrees * std::numbers::pi / 180, rolling = law() == ContactLaw::hertz ? 0.05 : 0.0;
    setup.timestep *= 5;
    setup.gravity = {g * std::sin(slope), 0, -g * std::cos(slope)};
    setup.surfaces[0].rolling_friction = rolling;
    WorkerEngine engine(worker());
    engine.start(setup);
    AdvanceRequest request = steps(std::llround(0.08 / setup.timestep));
    request.insert = {grain(r - 5e-5 * d, {0, 0, 0})};
    const double time = static_cast<double>(request.steps) * setup.timestep;
    const double theory = 5.0 / 7 * g * (std::sin(slope) - rolling * std::cos(slope)) * time;
    const double v = engine.advance(request).grains.vx[0];
    note("rolling: speed", degrees, v, theory);
    EXPECT_NEAR(v, theory, 0.02 * theory + 0.002) << degrees;
  }
}

// Contacts only take energy: motion, spin and height never hold more than at the start, nor much more than they held before (what
// contacts store comes back). Smooth and elastic, nothing is lost.
TEST_P(Impact, NeverAddsEnergy) {
  for (const auto& [lossless, damped] : {std::pair{true, true}, {false, true}, {false, false}}) {
    Folder folder;
    EngineSetup setup = box(folder.path);
    setup.contact = law();
    setup.tangential_damping = damped;
    setup.restitution = lossless ? 1 : 0.5;
    setup.linear = linear_contact(stiffness, setup.restitution);
    setup.timestep = 0.5 * stable_timestep(law(), stiffness);
    if (lossless) {
      setup.friction = setup.rolling_friction = 0;
      for (EngineSurface& s : setup.surfaces) s.friction = s.rolling_friction = 0;
      setup.gravity = {0, 0, 0};
      setup.surfaces.push_back({"lid", rectangle({0, 0, 0.07}, {0.036, 0, 0}, {0, 0.036, 0}), 0, 0});
    }
    WorkerEngine engine(worker());
    engine.start(setup);
    AdvanceRequest request = steps(1);
    request.insert = lattice(6, 4);
    for (NewGrain& n : request.insert) n.radius *= 0.9;  // clear of the walls: nothing is stored at the start
    double first = 0, least = 1e300, worst = 0, last = 0;
    for (int n = 0; n < 60; ++n) {
      const Advanced a = engine.advance(request);
      request.insert.clear();
      request.steps = 100;
      double energy = a.kinetic_energy;
      for (std::size_t i = 0; i < a.grains.size(); ++i) energy -= mass(a.grains.radius[i]) * setup.gravity[2] * a.grains.z[i];
      if (n == 0) first = energy;
      worst = std::max(worst, (energy - least) / first);
      least = std::min(least, energy);
      last = energy;
      EXPECT_LE(energy, first * (lossless ? 1.002 : 1 + 1e-12)) << "window " << n;
    }
    note(lossless ? "energy kept where lossless"
         : damped ? "energy: largest rise"
                  : "undamped: energy: largest rise",
         setup.restitution, lossless ? last / first : worst, lossless ? 1 : 0);
    if (lossless) {
      EXPECT_NEAR(last / first, 1, 0.01);
    } else {
      EXPECT_LT(worst, 0.02);
      EXPECT_LT(last, 0.8 * first);
    }
  }
}
