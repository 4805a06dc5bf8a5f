#include <gmock/gmock.h>

#include <set>

#include "coupling/plan/effects.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/plan/switches.hpp"
#include "coupling/scene/effect_names.hpp"
#include "coupling/scene/scene_error.hpp"
#include "tests/plan/plan_scenes.hpp"

namespace couloir {
namespace {

using testing::HasSubstr;

Effect effect(const Scene& scene, const std::string& name) {
  for (const Effect& e : effects_of(scene))
    if (e.name == name) return e;
  throw std::out_of_range(name);
}

Scene off(const std::string& name, const std::string& of, Overrides more = {}) {
  more.emplace_back("effects." + of, "off");
  return experiment(name, more);
}

TEST(Switches, HaveTheNamesOfTheEffects) {
  const auto all = effects_of(experiment("chiou_wall"));
  ASSERT_EQ(all.size(), effect_names.size());
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k].name, effect_names[k]);
}

TEST(Switches, LeaveThePlanAloneWhereItHasTheEffectOff) {
  for (const char* mode : {"continuum", "coupled", "grains"}) {
    for (const char* name : {"chiou_wall", "null_zone"}) {
      if (std::string(mode) == "grains" && std::string(name) == "null_zone") continue;  // its inflow is none of that mode's
      const Scene scene = experiment(name, {{"mode", mode}});
      const nlohmann::json plan = plan_json(make_plan(scene));
      for (const Effect& e : effects_of(scene))
        if (!e.on)
          EXPECT_EQ(plan_json(make_plan(off(name, e.name, {{"mode", mode}}))), plan) << name << " " << mode << " " << e.name;
    }
  }
}

TEST(Switches, SayWhatTheSceneCallsFor) {
  const std::string reason = effect(experiment("chiou_wall"), "curvature").reason;
  const Scene s = off("chiou_wall", "curvature");
  EXPECT_FALSE(effect(s, "curvature").on);
  EXPECT_EQ(effect(s, "curvature").reason, "switched off by hand, although the scene calls for it: " + reason);
  EXPECT_THAT(make_plan(s).warnings, testing::Contains("effects.curvature is off, although the scene calls for it (" + reason +
                                                       "): the run leaves it out."));
}

TEST(Switches, LeaveTheTermOut) {
  EXPECT_FALSE(
      as_run(off("chiou_wall", "refinement", {{"mode", "continuum"}, {"continuum.adapt.levels", "2"}})).continuum.refined());
  EXPECT_EQ(as_run(off("chiou_wall", "earth_pressure")).continuum.closure, "hydraulic");
  EXPECT_EQ(as_run(off("chiou_wall", "curvature")).continuum.curvature, "off");
  EXPECT_EQ(as_run(off("chiou_wall", "rolling_friction")).material.grain.rolling_friction, 0);
  EXPECT_EQ(as_run(off("chiou_wall", "rotation_control", {{"grains.rotation", "blocked"}})).grains.rotation, "free");
  const Scene s = off("chiou_wall", "basal_friction");
  EXPECT_EQ(as_run(s).material.grain.base_friction, 0) << "the bed brakes neither of the two models";
  EXPECT_GT(as_run(off("chiou_wall", "basal_friction", {{"mode", "grains"}})).material.grain.base_friction, 0);
  EXPECT_EQ(effect(s, "curvature").reason, "it is a part of the friction, which is switched off by hand");
  EXPECT_EQ(effect(s, "earth_pressure").reason, effect(experiment("chiou_wall"), "earth_pressure").reason);
}

TEST(Switches, RefuseWhatIsNoTerm) {
  const std::set<std::string> terms{"refinement",       "earth_pressure",   "basal_friction", "curvature",
                                    "rolling_friction", "rotation_control", "side_friction",  "airborne"};
  const Scene scene = experiment("chiou_wall");
  int refused = 0;
  for (const Effect& e : effects_of(scene)) {
    if (!e.on || terms.contains(e.name)) continue;
    ++refused;
    try {
      make_plan(off("chiou_wall", e.name));
      ADD_FAILURE() << e.name << " was left out";
    } catch (const SceneError& error) {
      EXPECT_THAT(error.what(), HasSubstr("effects." + e.name + " is off, but the scene calls for it (" + e.reason + ")"));
    }
  }
  EXPECT_GE(refused, 5);
}

TEST(Switches, AreKeptInTheScenesRecord) {
  const Scene s = off("chiou_wall", "curvature");
  const Scene again = read_scene_text(write_scene(s), "again", std::string(COULOIR_SOURCE_DIR) + "/dem_inputs/materials");
  EXPECT_EQ(again.left_out, std::vector<std::string>{"curvature"});
  EXPECT_EQ(write_scene(experiment("chiou_wall")).find("effects:"), std::string::npos);
}

}  // namespace
}  // namespace couloir
