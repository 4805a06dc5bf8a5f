#include <cmath>
#include <numbers>

#include "scene_fixture.hpp"

namespace couloir {
namespace {

using Materials = SceneFixture;
constexpr double deg = std::numbers::pi / 180;

struct Row {
  const char* name;
  double density, phi, delta, diameter;
};

// Table 4.1; Toyoura sand: Moriguchi et al. (2009).
const Row rows[] = {{"quartz", 1639, 40, 28, 0.005},
                    {"yellow_sand", 1661, 33, 27, 0},
                    {"vestolen", 639, 37, 24, 0.004},
                    {"toyoura", 1379, 35, 35, 0}};

TEST_F(Materials, HoldTheTablesNumbers) {
  for (const Row& row : rows) {
    const Material m = read(replaced(good_scene, "vestolen", row.name)).material;
    EXPECT_EQ(m.name, row.name);
    EXPECT_EQ(m.density, row.density) << row.name;
    EXPECT_DOUBLE_EQ(m.phi, row.phi * deg) << row.name;
    EXPECT_DOUBLE_EQ(m.delta, row.delta * deg) << row.name;
    EXPECT_EQ(m.diameter, row.diameter) << row.name;
    EXPECT_NEAR(m.grain.base_friction, std::tan(m.delta), 0.01) << row.name;
    EXPECT_FALSE(m.calibration.empty()) << row.name << ": tests/calibration checks that its values are the record's";
  }
}

TEST_F(Materials, AreTestedAllOfThem) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(materials_folder)) files += entry.path().extension() == ".yaml";
  EXPECT_EQ(files, std::size(rows));
}

TEST_F(Materials, UnknownNamesTheOnesThereAre) {
  EXPECT_EQ(error(replaced(good_scene, "vestolen", "vestlen")),
            "scene.yaml:3: material 'vestlen' is unknown; there are quartz, toyoura, vestolen, yellow_sand, or write its keys "
            "inline; did you "
            "mean 'vestolen'?");
}

TEST_F(Materials, InlineAndOverridden) {
  const std::string text =
      replaced(good_scene, "vestolen",
               "{density: 1500, internal_friction_angle: 30 deg, basal_friction_angle: 20 deg, grains: {friction: 0.7}}");
  EXPECT_EQ(read(text).material.grain.friction, 0.7);
  EXPECT_EQ(read(text).material.grain.restitution, GrainMaterial{}.restitution);
  EXPECT_EQ(read(replaced(text, "  diameter", "  friction: 0.6\n  diameter")).material.grain.friction, 0.6)
      << "the scene's grains go last";
  const Scene s = read(good_scene, {{"material.basal_friction_angle", "20 deg"}});
  EXPECT_DOUBLE_EQ(s.material.delta, 20 * deg);
  EXPECT_EQ(s.material.density, 639) << "the rest of the file stays";
}

TEST_F(Materials, AnErrorInTheFileNamesTheFile) {
  std::ofstream(folder_ / "mud.yaml") << "density: 1500\ninternal_friction_angel: 30 deg\n";
  std::ofstream(file()) << replaced(good_scene, "vestolen", "mud");
  try {
    read_scene(file(), folder_.string());
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_EQ(std::string(e.what()), folder_.string() +
                                         "/mud.yaml:2: material.internal_friction_angel is unknown; did you mean "
                                         "'internal_friction_angle'?");
  }
}

TEST_F(Materials, ScalesDoNotReachIntoTheFile) {
  std::ofstream(folder_ / "mud.yaml")
      << "density: 1500\ninternal_friction_angle: 30 deg\nbasal_friction_angle: 20 deg\ndiameter: 0.004\n";
  std::ofstream(file()) << replaced(good_scene, "vestolen", "mud") + "scales: {length: 100 mm}\n";
  EXPECT_EQ(read_scene(file(), folder_.string()).material.diameter, 0.004);
}

}  // namespace
}  // namespace couloir
