#include "coupling/loop/energy_guard.hpp"

#include <fmt/format.h>

#include "../engine/small_box.hpp"
#include "continuum/errors.hpp"
#include "small_run.hpp"

namespace couloir::test {
namespace {

struct Guard : OnEngine {};
INSTANTIATE_TEST_SUITE_P(On, Guard, engines, name_of_engine);

// What the guard says of grains that fall into a box; "" where it says nothing.
std::string said_of(const std::string& worker, double step_factor, std::vector<NewGrain> grains, int windows) {
  Folder folder;
  EngineSetup setup = box(folder.path);
  const double stable = setup.timestep;
  setup.timestep *= step_factor;
  WorkerEngine engine(worker);
  engine.start(setup);
  EnergyGuard guard(setup, stable);
  AdvanceRequest request = steps(4);
  request.insert = std::move(grains);
  Grains before;
  for (int k = 0; k < windows; ++k) {
    Advanced now;
    try {
      try {
        now = engine.advance(request);
      } catch (const RunawayError& error) {
        guard.explain(error);
      }
      guard.look(request, before, now);
    } catch (const NumericsError& error) {
      EXPECT_NE(std::string(error.what()).find(fmt::format("by step {} ", 4 * (k + 1))), std::string::npos) << error.what();
      return error.what();
    }
    before = now.grains;
    request.insert.clear();
    request.remove.clear();
    if (k == windows / 2) request.remove = {now.grains.id.front(), now.grains.id.back()};
  }
  return "";
}

}  // namespace

TEST_P(Guard, LetsGrainsFallAndSettle) {
  EXPECT_EQ(said_of(worker(), 1, lattice(8, 4), 500), "");
}

TEST_P(Guard, StopsATimeStepThatMakesEnergy) {
  const std::string what = said_of(worker(), 10, lattice(8, 4), 500);
  EXPECT_NE(what.find("10.00 times the stable one"), std::string::npos) << what;
  EXPECT_NE(what.find("lower grains.timestep"), std::string::npos) << what;
}

// Two grains of 4 mm at 30 m/s each: more than a radius deep in each other, whatever the energy.
TEST_P(Guard, StopsGrainsThatMayPassThroughEachOther) {
  const NewGrain left{1, {0.02, 0.03, 0.03}, {30, 0, 0}, 0.002}, right{2, {0.03, 0.03, 0.03}, {-30, 0, 0}, 0.002};
  const std::string what = said_of(worker(), 1, {left, right}, 30);
  EXPECT_NE(what.find("more than a radius"), std::string::npos) << what;
  EXPECT_NE(what.find("raise grains.youngs_modulus"), std::string::npos) << what;
}

TEST_P(Guard, StopsGrainsThatAreBornInEachOther) {
  std::vector<NewGrain> grains = lattice(8, 2);
  for (NewGrain& n : lattice(8, 2, 1001, 1.0 * d)) grains.push_back(n);
  const std::string what = said_of(worker(), 1, grains, 100);
  EXPECT_NE(what.find("overlap where they were put in"), std::string::npos) << what;
}

TEST(EnergyGuard, NoticesASlowLeak) {
  EngineSetup setup;
  setup.timestep = 1e-5;
  setup.gravity = {0, 0, -g};
  setup.density = density;
  setup.max_radius = 0.5 * d;
  EnergyGuard guard(setup, 1e-5);
  const double m = grain_mass(0.5 * d, density);
  Advanced a;
  a.grains = {{1}, {0}, {0}, {1}, {0}, {0}, {0}, {0.5 * d}, {0}};
  AdvanceRequest first;
  first.insert = {{1, {0, 0, 1}, {}, 0.5 * d}};
  guard.look(first, {}, a);
  // a free fall of 0.1 m explains its motion; what comes on top, a hundredth of it at a time, is noticed when it is as much
  a.grains.z[0] = 0.9;
  a.kinetic_energy = m * g * 0.1;
  guard.look({}, a.grains, a);
  EXPECT_NEAR(guard.state().unexplained, 0, 1e-15);
  int windows = 0;
  EXPECT_THROW(
      for (; windows < 200; ++windows) {
        a.kinetic_energy += m * g * 0.1 / 100;
        guard.look({}, a.grains, a);
      },
      NumericsError);
  EXPECT_NEAR(windows, 100 * (1 + d / 0.1), 2);
}

}  // namespace couloir::test
