// An effect that the plan has off may be switched off by hand: not a bit of the run changes. One that the scene calls for: the
// run is another, and says so.

#include <gmock/gmock.h>

#include <set>
#include <sstream>

#include "coupling/plan/effects.hpp"
#include "coupling/scene/effect_names.hpp"
#include "tests/loop/small_run.hpp"

namespace couloir {
namespace {

// All that the observers are told but how long it took, as bytes.
std::vector<std::uint8_t> bytes_of(Watched& w) {
  Archive a;
  for (WindowReport& window : w.windows) a(window);
  for (Event& event : w.events) a(event);
  for (std::vector<double>& frame : w.frames) a(frame);
  return a.bytes();
}

Watched run(const std::string& scene, Overrides set, const std::string& off = "") {
  if (!off.empty()) set.emplace_back("effects." + off, "off");
  const Scene read = read_scene(COULOIR_SOURCE_DIR "/" + scene, COULOIR_SOURCE_DIR "/dem_inputs/materials", set);
  return watch(read, options_in(fresh_folder("switches")));
}

std::vector<Effect> effects(const std::string& scene, const Overrides& set) {
  return effects_of(read_scene(COULOIR_SOURCE_DIR "/" + scene, COULOIR_SOURCE_DIR "/dem_inputs/materials", set));
}

struct Case {
  std::string name, scene;
  Overrides set;
};

// Between them every effect is off in one.
const Case slab{"slab", "tests/scenes/slab.yaml", {}};
const Case bare{"bare", "bench/scenes/incline.yaml", {{"continuum.cell", "160 mm"}}};
const Case level{
    "level", "tests/scenes/slab.yaml", {{"terrain", "{kind: flat, length: 1 m, width: 10 mm}"}, {"release.width", "10 mm"}}};
const Case noc{"noc", "tests/scenes/slab.yaml", {{"continuum.scheme", "noc"}}};
const Case coupled{"coupled", "tests/scenes/small_wall.yaml", {{"duration", "0.12 s"}}};
const Case no_wall{"no_wall", "tests/scenes/small_wall.yaml", {{"duration", "0.12 s"}, {"obstacles", "{}"}}};
const Case grains{"grains", "tests/scenes/small_wall.yaml", {{"mode", "grains"}, {"duration", "30 ms"}}};
const std::vector<Case> cases{slab, bare, level, noc, coupled, no_wall, grains};

class Switches : public testing::TestWithParam<Case> {};

TEST_P(Switches, ChangeNoBitWhereThePlanHasTheEffectOff) {
  const auto& [name, scene, set] = GetParam();
  Watched whole = run(scene, set);
  ASSERT_EQ(whole.end.status, "done");
  if (whole.end.cpu_engine > 0) ASSERT_GT(whole.windows.back().grains, 0);
  const auto bytes = bytes_of(whole);
  ASSERT_GT(bytes.size(), 1000U);
  Overrides all = set;
  std::vector<std::string> off;
  for (const Effect& e : effects(scene, set))
    if (!e.on) off.push_back(e.name);
  ASSERT_FALSE(off.empty());
  for (const std::string& effect : off) all.emplace_back("effects." + effect, "off");
  Watched without = run(scene, all);  // all at once
  EXPECT_EQ(bytes_of(without), bytes);
  const bool quick = whole.end.cpu_engine == 0;
  for (std::size_t k = 0; quick && k < off.size(); ++k) {
    Watched one = run(scene, set, off[k]);
    EXPECT_EQ(bytes_of(one), bytes) << off[k];
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Switches, testing::ValuesIn(cases), [](const auto& info) { return info.param.name; });

TEST(SwitchesOfAll, EveryEffectIsOffInSomeScene) {
  std::set<std::string> off;
  for (const Case& c : cases)
    for (const Effect& e : effects(c.scene, c.set))
      if (!e.on) off.insert(e.name);
  for (const char* name : effect_names) EXPECT_TRUE(off.contains(name)) << name;
}

TEST(SwitchesOfAll, ChangeTheRunWhereTheSceneCallsForTheEffectAndSaySo) {
  const Overrides arc{{"terrain", "{kind: chute, angle: 30 deg, slope: 0.3 m, arc: 0.4 m, runout: 0.3 m, width: 0.1 m}"},
                      {"continuum.closure", "active_passive"},
                      {"continuum.adapt.levels", "1"}};
  Watched whole = run(slab.scene, arc);
  for (const std::string name : {"refinement", "earth_pressure", "basal_friction", "curvature"}) {
    Watched without = run(slab.scene, arc, name);
    EXPECT_NE(bytes_of(without), bytes_of(whole)) << name;
    std::ostringstream told;
    for (const Event& e : without.events) told << e.what << "\n";
    EXPECT_THAT(told.str(), testing::HasSubstr("warning: effects." + name + " is off, although the scene calls for it ("));
    // So that the events are not what differs.
    EXPECT_NE(without.windows.back().momentum.storage, whole.windows.back().momentum.storage) << name;
  }
}

}  // namespace
}  // namespace couloir
