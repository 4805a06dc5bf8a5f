#include "coupling/study/advice.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/scene/scene_error.hpp"
#include "tests/check/check_folder.hpp"

namespace couloir {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double deg = std::numbers::pi / 180;
const std::string materials = COULOIR_SOURCE_DIR "/dem_inputs/materials",
                  wall = COULOIR_SOURCE_DIR "/tests/scenes/small_wall.yaml";

TEST(Likeness, DistanceIsAFactorOfEInOneNumber) {
  const Likeness a{3, 0.5, 5, 35 * deg, "cuboid"};
  EXPECT_EQ(distance(a, a), 0);
  Likeness b = a;
  b.froude *= std::numbers::e;
  EXPECT_NEAR(distance(a, b), 1, 1e-12);
  b.slope += 10 * deg;
  EXPECT_NEAR(distance(a, b), std::sqrt(2), 1e-12);
  b.obstacle = "mesh";
  EXPECT_NEAR(distance(a, b), std::sqrt(3), 1e-12);
  b.depth_over_diameter = NAN;
  EXPECT_NEAR(distance(a, b), 2, 1e-12);
  EXPECT_EQ(distance(b, a), distance(a, b));
}

TEST(Likeness, IsThatOfTheFlowBeforeTheObstacle) {
  const Scene scene = read_scene(wall, materials);
  const Likeness l = likeness(scene);
  EXPECT_EQ(l.obstacle, "cuboid");
  EXPECT_NEAR(l.slope, 35 * deg, 1e-12);
  EXPECT_NEAR(l.depth_over_height / l.depth_over_diameter, 6.0 / 40, 1e-12);
  EXPECT_EQ(
      likeness(read_scene(wall, materials, {{"mode", "continuum"}, {"obstacles.wall.size", "[10 mm, 200 mm, 40 mm]"}})).obstacle,
      "cuboid across");
  const Likeness back = likeness_from(nlohmann::json::parse(likeness_json(l).dump()));
  EXPECT_EQ(distance(l, back), 0);
}

struct Advised : ::testing::Test {
  CheckFolder folder{"advice"};
  Likeness of = likeness(read_scene(wall, materials));

  using Json = nlohmann::ordered_json;

  std::string ladder(const std::string& quantity, const Likeness& scene, const Json& zone = {{"grains.window", "20"}}) const {
    const auto figures = [](double bias, double scatter) {
      return Json{{"value", 1},    {"bias", bias}, {"scatter", scatter}, {"error", std::hypot(bias, scatter)},
                  {"doubt", 0.01}, {"step", 0},    {"front", true}};
    };
    const Json rungs{{{"name", "point"},
                      {"mode", "mass point"},
                      {"set", Json::object()},
                      {"cells_in_depth", nullptr},
                      {"grains_in_depth", nullptr},
                      {"packings", 1},
                      {"cpu", 1e-4},
                      {"planned", 0}},
                     {{"name", "cells"},
                      {"mode", "continuum"},
                      {"set", {{"continuum.cell", "3 mm"}, {"continuum.limiter", "mc"}}},
                      {"cells_in_depth", 2},
                      {"grains_in_depth", nullptr},
                      {"packings", 1},
                      {"cpu", 2},
                      {"planned", 4}},
                     {{"name", "zone"},
                      {"mode", "coupled"},
                      {"set", zone},
                      {"cells_in_depth", 2},
                      {"grains_in_depth", 3},
                      {"packings", 3},
                      {"cpu", 20},
                      {"planned", 10}}};
    return Json{{"format", "couloir ladder"},
                {"format_version", 1},
                {"name", "x"},
                {"scene", likeness_json(scene)},
                {"rungs", rungs},
                {"quantities", Json::array({{{"quantity", quantity},
                                             {"unit", "N s"},
                                             {"source", "rung grains"},
                                             {"floor", 0.03},
                                             {"rungs", {figures(0.5, 0), figures(0.15, 0), figures(0.03, 0.08)}}}})}}
        .dump();
  }
  void keep(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(folder / name);
    folder.write(name + "/ladder.json", text);
  }
  Advice advised(double error, const std::string& quantity = "", const Overrides& set = {}) const {
    return advise(wall, materials, set, error, quantity, kept_ladders(folder / ""));
  }
  std::string wrong(const std::string& quantity = "") const {
    try {
      advised(0.1, quantity);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Advised, ByTheNearestLadderThatHasTheQuantity) {
  Likeness far = of;
  far.froude *= 10;
  keep("far", ladder("obstacles.wall.impulse", far));
  keep("near", ladder("obstacles.wall.force_peak", of));
  EXPECT_THAT(advised(0.2).ladder.file, HasSubstr("near/ladder.json"));
  const Advice other = advised(0.2, "obstacles.wall.impulse");
  EXPECT_THAT(other.ladder.file, HasSubstr("far/ladder.json"));
  EXPECT_NEAR(other.distance, std::log(10), 1e-9);
  EXPECT_STREQ(trust(other.distance), "unlike this scene: a guess");
  EXPECT_THAT(wrong("obstacles.wall.impuls"), HasSubstr("no ladder is of it; did you mean 'obstacles.wall.impulse'?"));
}

TEST_F(Advised, ByAnObstacleOfAnotherNameButNotOnOneThatIsNotThere) {
  keep("dam", ladder("obstacles.dam.impulse", of));
  EXPECT_EQ(advised(0.2, "obstacles.wall.impulse").choice.rung, 1);
  EXPECT_THAT(wrong("obstacles.dam.impulse"), HasSubstr("the scene has no such one; it has wall"));
  keep("dam", ladder("gauges.far.arrival", of));
  EXPECT_THAT(wrong(), HasSubstr("no ladder has a quantity of a scene without obstacles and gauges"));
}

// A rung whose keys are of its own scene would be another one here.
TEST_F(Advised, ByRungsThatCanBeSetHere) {
  const Json zone{{"grains.zone", "{x: [260 mm, 440 mm], y: [-70 mm, 70 mm]}"}};
  keep("a", ladder("obstacles.wall.impulse", of, zone));
  EXPECT_EQ(advised(0.06).choice.rung, -1);
  EXPECT_EQ(advised(0.06).nearest, 1);
  const std::string own = folder / "a/scene.yaml";
  std::filesystem::copy_file(wall, own);
  const Advice advice = advise(own, materials, {}, 0.06, "", kept_ladders(folder / ""));
  ASSERT_EQ(advice.choice.rung, 2) << advice_text(advice, own);
  EXPECT_EQ(advice.set.back().first, "grains.zone");
}

TEST_F(Advised, ByRungsThatTheSceneTakes) {
  keep("a", ladder("obstacles.wall.impulse", of, {{"grains.window", "0"}}));
  const Advice advice = advised(0.06);
  EXPECT_EQ(advice.choice.rung, -1);
  EXPECT_THAT(advice_text(advice, wall), HasSubstr("this scene refuses zone: "));
}

TEST_F(Advised, TheCommandHasWhatTheCallerSet) {
  keep("a", ladder("obstacles.wall.impulse", of));
  const Advice advice = advised(0.2, "", {{"release.height", "25 mm"}});
  EXPECT_THAT(advice_text(advice, "my scene's.yaml"),
              HasSubstr("couloir run 'my scene'\\''s.yaml' --set 'release.height=25 mm' --set mode=continuum"));
}

TEST_F(Advised, WithAsManyCellsAndGrainsInTheDepth) {
  keep("a", ladder("obstacles.wall.impulse", of));
  EXPECT_EQ(advised(0.6).choice.rung, 0);
  EXPECT_THAT(advice_text(advised(0.6), wall), HasSubstr("couloir plan " + wall));
  const Advice cells = advised(0.2);
  const double depth = depth_before(read_scene(wall, materials));
  EXPECT_THAT(cells.set,
              ElementsAre(std::pair("mode", "continuum"), std::pair("continuum.cell", fmt::format("{:.3g} mm", depth / 2 * 1e3)),
                          std::pair("continuum.limiter", "mc")));
  const Advice zone = advised(0.06);
  EXPECT_EQ(zone.choice.rung, 2);
  EXPECT_EQ(zone.choice.packings, 3);  // 0.03^2 + 0.08^2 / 3 < 0.06^2
  EXPECT_GT(zone.cost, 0);
  const std::string text = advice_text(zone, wall);
  EXPECT_THAT(text, HasSubstr("for 6 %: zone, the mean of 3 packings"));
  EXPECT_THAT(text, HasSubstr("distance 0, much like this scene"));
  EXPECT_THAT(zone.set.back(), std::pair(std::string("grains.window"), std::string("20")));
  EXPECT_EQ(advice_json(zone, wall)["rung"], "zone");
  EXPECT_EQ(advised(0.01).choice.rung, -1);
  EXPECT_THAT(advice_text(advised(0.01), wall),
              HasSubstr("for 1 %: no rung, not even by the mean of 30 packings; the best, zone, is off by 3.3 %"));
}

TEST_F(Advised, RefusesWhatIsNoLadder) {
  EXPECT_THAT(wrong(), HasSubstr("holds no ladder.json"));
  keep("a", "{\"format\": \"couloir ladder\", \"format_version\": 1}");
  EXPECT_THAT(wrong(), HasSubstr("a/ladder.json: cannot be read as a ladder"));
  Json whole = Json::parse(ladder("obstacles.wall.impulse", of));
  whole["rungs"][1]["cpu"] = nullptr;
  keep("a", whole.dump());
  EXPECT_THAT(wrong(), HasSubstr("a/ladder.json: has a rung that cost nothing; couloir study with --keep makes it anew"));
  whole["rungs"] = Json::array(), whole["quantities"][0]["rungs"] = Json::array();
  keep("a", whole.dump());
  EXPECT_THAT(wrong(), HasSubstr("a/ladder.json: has no rungs"));
  keep("a", "{\"format\": \"couloir ladder\", \"format_version\": 2}");
  EXPECT_THAT(wrong(), HasSubstr("is no ladder of this version; couloir study with --keep makes it anew"));
}

}  // namespace
}  // namespace couloir
