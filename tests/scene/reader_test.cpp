#include "coupling/scene/reader.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "coupling/scene/inflow.hpp"
#include "scene_fixture.hpp"

namespace couloir {
namespace {

using ::testing::HasSubstr;
using Reader = SceneFixture;
constexpr double deg = std::numbers::pi / 180;

TEST_F(Reader, ReadsEveryPart) {
  const Scene s = read(good_scene);
  EXPECT_EQ(s.file, file());
  EXPECT_EQ(s.text, good_scene);
  EXPECT_EQ(s.mode, Mode::coupled);
  EXPECT_EQ(s.terrain.kind, TerrainSpec::Kind::incline);
  EXPECT_DOUBLE_EQ(s.terrain.angle, 35 * deg);
  EXPECT_EQ(s.terrain.length, 2);
  EXPECT_EQ(s.material.name, "vestolen");
  EXPECT_EQ(s.release.kind, ReleaseSpec::Kind::block);
  EXPECT_EQ(s.release.x, 0.1);
  EXPECT_EQ(s.release.width, 0.2);
  ASSERT_EQ(s.obstacles.size(), 1u);
  EXPECT_EQ(s.obstacles[0].name, "wall");
  EXPECT_EQ(s.obstacles[0].x, 1.2);
  EXPECT_EQ(s.obstacles[0].length, 0.02);
  EXPECT_EQ(s.obstacles[0].height, 0.08);
  EXPECT_EQ(s.sides[2].kind, SideSpec::Kind::wall);
  EXPECT_EQ(s.continuum.cell, 0.01);
  EXPECT_EQ(s.grains.diameter, 0.005);
  EXPECT_EQ(s.duration, 1);
}

TEST_F(Reader, FillsInDefaults) {
  const Scene s = read(good_scene), blank;
  EXPECT_EQ(s.gravity, 9.81);
  EXPECT_EQ(s.sides[0].kind, SideSpec::Kind::outflow);
  EXPECT_EQ(s.sides[1].kind, SideSpec::Kind::outflow);
  EXPECT_EQ(s.continuum.cfl, blank.continuum.cfl);
  EXPECT_EQ(s.continuum.closure, "active_passive");
  EXPECT_EQ(s.grains.engine, "liggghts");
  EXPECT_EQ(s.grains.seed, blank.grains.seed);
  EXPECT_TRUE(s.grains.zones.empty());
  EXPECT_EQ(s.record.frames, blank.record.frames);
}

TEST_F(Reader, ReadsAFolder) {
  std::ofstream(file()) << good_scene;
  const Scene s = read_scene(folder_.string(), materials_folder);
  EXPECT_EQ(s.file, folder_.string());
  EXPECT_EQ(s.duration, 1);
}

TEST_F(Reader, ReadsInflowAndZoneBox) {
  const Scene s = read(good_scene, {{"boundaries.upstream", "{inflow: {depth: 40 mm, velocity: 2 m/s}}"},
                                    {"grains.zone", "{x: [1 m, 1.4 m], y: [-0.2, 0.2]}"}});
  EXPECT_EQ(s.sides[0].kind, SideSpec::Kind::inflow);
  EXPECT_EQ(s.sides[0].depth, 0.04);
  EXPECT_EQ(s.sides[0].velocity, 2);
  ASSERT_EQ(s.grains.zones.size(), 1u);
  EXPECT_EQ(s.grains.zones[0].x1, 1.4);
  EXPECT_EQ(s.grains.zones[0].y0, -0.2);
}

TEST_F(Reader, ReadsInflowsAndGauges) {
  Scene s = read(good_scene,
                 {{"boundaries.upstream", "{inflow: {kind: hydrograph, hydrograph: [[0, 0, 1], [200 ms, 4 cm, 2 m/s]]}}"},
                  {"record.gauges", "{front: {position: [1 m, 10 mm]}, back: {position: [1.8 m, 0], size: [10 cm, 0.2]}}"}});
  EXPECT_EQ(s.sides[0].inflow, SideSpec::Inflow::hydrograph);
  ASSERT_EQ(s.sides[0].hydrograph.size(), 2u);
  EXPECT_EQ(s.sides[0].hydrograph[1].time, 0.2);
  EXPECT_EQ(s.sides[0].hydrograph[1].depth, 0.04);
  EXPECT_EQ(s.sides[0].hydrograph[1].velocity, 2);
  const Scene two = read(good_scene, {{"obstacles.post", "{position: [1.6 m, 0], size: [20 mm, 50 mm, 50 mm]}"},
                                      {"obstacles.wall.gauges", "{a: {centre: [-10 mm, 40 mm], radius: 20 mm}}"},
                                      {"obstacles.post.gauges", "{a: {centre: [0, 20 mm], size: [1 cm, 0.02]}}"},
                                      {"obstacles.post.gauges.a.size", "[1 cm, 0.03]"}});
  ASSERT_EQ(two.stress_gauges.size(), 2u);
  EXPECT_EQ(two.stress_gauges[0].obstacle, 0);
  EXPECT_EQ(two.stress_gauges[0].across, -0.01);
  EXPECT_EQ(two.stress_gauges[0].radius, 0.02);
  EXPECT_EQ(two.stress_gauges[1].obstacle, 1);
  EXPECT_EQ(two.stress_gauges[1].up, 0.02);
  EXPECT_EQ(two.stress_gauges[1].height, 0.03);
  ASSERT_EQ(s.record.gauges.size(), 2u);
  EXPECT_EQ(s.record.gauges[0].name, "front");
  EXPECT_EQ(s.record.gauges[0].y, 0.01);
  EXPECT_EQ(s.record.gauges[0].length, 0);
  EXPECT_EQ(s.record.gauges[1].length, 0.1);
  EXPECT_EQ(s.record.gauges[1].width, 0.2);

  s = read(good_scene, {{"boundaries.upstream", "{inflow: {kind: silo, gate: 18 mm}}"}, {"release", "{kind: none}"}});
  EXPECT_EQ(s.sides[0].gate, 0.018);
  // Vestolen, d = 4 mm: 1.03 sqrt(9.81) (18 - 5.6)^1.5 / 18.
  const GreatestInflow q = greatest_inflow(s, s.sides[0]);
  EXPECT_NEAR(q.velocity, 1.03 * std::sqrt(9.81) * std::pow(0.0124, 1.5) / 0.018, 1e-12);
  EXPECT_EQ(q.depth, 0.018);
}

TEST_F(Reader, SaysWhatIsWrongWithAnInflow) {
  const auto with = [&](const std::string& inflow) { return error(good_scene, {{"boundaries.upstream.inflow", inflow}}); };
  EXPECT_THAT(with("{kind: hydrograph, hydrograph: [[0, 1 cm, 1], [1 s, 1 cm]]}"),
              HasSubstr("inflow.hydrograph[1] has 2, but a row needs 3 numbers: time, depth, velocity"));
  EXPECT_THAT(with("{kind: hydrograph, hydrograph: [[0, 1 cm, 1], []]}"),
              HasSubstr("inflow.hydrograph[1] has 0, but a row needs"));
  EXPECT_THAT(with("{kind: hydrograph, hydrograph: [0, 1 cm, 1]}"),
              HasSubstr("inflow.hydrograph[0] is '0', but a row needs 3 numbers: time, depth, velocity"));
  EXPECT_THAT(with("{kind: hydrograph, hydrograph: [[0, 1 kg, 1], [1 s, 1 cm, 1]]}"),
              HasSubstr("inflow.hydrograph[0][1] is '1 kg', but 'kg' is not a unit of a length"));
  EXPECT_THAT(with("{kind: hydrograph, hydrograph: [[1 s, 1 cm, 1], [0, 1 cm, 1]]}"), HasSubstr("the times must rise"));
  EXPECT_THAT(with("{kind: hydrograph, hydrograph: [[0, 0, 1], [1 s, 0, 1]]}"), HasSubstr("lets nothing in"));
  EXPECT_THAT(with("{kind: hydrograph, hydrograph: [[0, 0, 1]]}"), HasSubstr("give at least 2"));
  EXPECT_THAT(with("{kind: hydrograph, hydrograph: [[0, -1 mm, 1], [1 s, 0, 1]]}"), HasSubstr("out of bounds"));
  EXPECT_THAT(with("{kind: silo, gate: 3 mm}"), HasSubstr("too narrow for grains of 4 mm"));
  EXPECT_THAT(with("{depth: 1 cm, velocity: 1, gate: 3 mm}"),
              HasSubstr("gate does not belong to kind 'uniform'; it is for silo"));
  EXPECT_THAT(error(good_scene, {{"release", "{kind: none}"}}), HasSubstr("no side is an inflow"));
  EXPECT_THAT(error(good_scene, {{"boundaries.upstream", "{inflow: {depth: 20 mm, velocity: 1}}"},
                                 {"obstacles", "{w: {position: [0, 0], size: [20 mm, 100 mm, 50 mm]}}"}}),
              HasSubstr("obstacles.w stands on a side through which material comes in"));
  EXPECT_THAT(error(good_scene, {{"record.gauges", "{far: {position: [3 m, 0]}}"}}), HasSubstr("outside of the domain"));
}

TEST_F(Reader, ScalesBareNumbers) {
  const std::string text =
      "mode: continuum\n"
      "scales: {length: 33.33 mm}\n"
      "terrain: {kind: chute, angle: 40 deg, slope: 25, arc: 4.4, runout: 835 mm, width: 24}\n"
      "material: {density: 639, internal_friction_angle: 37 deg, basal_friction_angle: 24 deg}\n"
      "release: {kind: ellipsoid, centre: [4.74, 0], semi_axes: [4.74, 4.74, 1.8], mass: 50, velocity: 0.5}\n"
      "continuum: {cell: 0.1}\n"
      "duration: 24\n";
  const Scene s = read(text);
  const double L = 33.33 / 1000, g = 9.81;
  EXPECT_DOUBLE_EQ(s.terrain.slope, 25 * L);
  EXPECT_EQ(s.terrain.runout, 0.835);
  EXPECT_DOUBLE_EQ(s.release.semi_z, 1.8 * L);
  EXPECT_DOUBLE_EQ(s.release.mass, 50 * 639 * L * L * L);
  EXPECT_DOUBLE_EQ(s.release.velocity, 0.5 * std::sqrt(L * g));
  EXPECT_DOUBLE_EQ(s.duration, 24 * std::sqrt(L / g));
  EXPECT_EQ(s.material.density, 639);
  EXPECT_EQ(s.record.frames, 0.02) << "defaults are SI";
  EXPECT_EQ(read(text, {{"continuum.cell", "0.2"}}).continuum.cell, 0.2 * L) << "overrides are scaled as the file is";
}

TEST_F(Reader, NamesTheNearestKey) {
  EXPECT_EQ(error(replaced(good_scene, "  cell:", "  clf: 0.4\n  cell:")),
            "scene.yaml:9: continuum.clf is unknown; did you mean 'cfl'?");
  EXPECT_EQ(error(replaced(good_scene, "grains:", "grans:")), "scene.yaml:10: grans is unknown; did you mean 'grains'?");
  EXPECT_EQ(error(replaced(good_scene, "size:", "sise:")), "scene.yaml:6: obstacles.wall.sise is unknown; did you mean 'size'?");
}

TEST_F(Reader, ListsTheKeysIfNoneIsNear) {
  EXPECT_EQ(
      error(replaced(good_scene, "  cell:", "  colour: red\n  cell:")),
      "scene.yaml:9: continuum.colour is unknown; continuum takes scheme, cell, cell_across, cfl, closure, limiter, curvature, "
      "block, refine, adapt");
}

TEST_F(Reader, SaysWhatIsMissing) {
  EXPECT_EQ(error(replaced(good_scene, "duration: 1 s\n", "")),
            "scene.yaml:1: duration is missing: simulated; give a time in s, ms, us, min");
  EXPECT_EQ(error(replaced(good_scene, ", width: 0.5 m", "")),
            "scene.yaml:2: terrain.width is missing: across; y runs from -width/2 to width/2; give a length in m, mm, cm, km");
  EXPECT_EQ(error(replaced(good_scene, "kind: block, ", "")),
            "scene.yaml:4: release.kind is missing: its shape; give one of cap, ellipsoid, block, uniform, none");
}

TEST_F(Reader, SaysWhatAKindTakes) {
  EXPECT_EQ(error(replaced(good_scene, "length: 2 m,", "length: 2 m, arc: 1 m,")),
            "scene.yaml:2: terrain.arc does not belong to kind 'incline'; it is for chute");
}

TEST_F(Reader, SaysWhichTypeIsWanted) {
  EXPECT_EQ(error(replaced(good_scene, "cell: 10 mm", "cell: [1, 2]")),
            "scene.yaml:9: continuum.cell is a list, but must be a length in m, mm, cm, km");
  EXPECT_EQ(error(replaced(good_scene, "[1.2 m, 0]", "1.2 m")),
            "scene.yaml:6: obstacles.wall.position is '1.2 m', but must be a list of 2 numbers in m, mm, cm, km");
  EXPECT_EQ(error(replaced(good_scene, "[1.2 m, 0]", "[1.2 m]")),
            "scene.yaml:6: obstacles.wall.position is a list of 1, but must be a list of 2 numbers in m, mm, cm, km");
  EXPECT_EQ(error(replaced(good_scene, "  diameter", "  seed: 1.5\n  diameter")),
            "scene.yaml:11: grains.seed is '1.5', but must be a whole number, from 1 to 2147483647");
  EXPECT_EQ(error(replaced(good_scene, "{left: wall, right: wall}", "wall")),
            "scene.yaml:7: boundaries is 'wall', but must be a mapping with upstream, downstream, left, right");
  EXPECT_EQ(error("duration:\n" + replaced(good_scene, "duration: 1 s\n", "")),
            "scene.yaml:1: duration is empty, but must be a time in s, ms, us, min");
  EXPECT_EQ(error("[1, 2]"), "scene.yaml:1: a scene is a mapping of keys, but this is a list");
}

TEST_F(Reader, SaysWhichUnitsAreAllowed) {
  EXPECT_EQ(error(replaced(good_scene, "10 mm", "10 kg")),
            "scene.yaml:9: continuum.cell is '10 kg', but 'kg' is not a unit of a length; write one of m, mm, cm, km");
  EXPECT_EQ(error(replaced(good_scene, "35 deg", "35")),
            "scene.yaml:2: terrain.angle is 35, an angle without a unit; write '35 deg' or '35 rad'");
  EXPECT_EQ(error(replaced(good_scene, "[1.2 m, 0]", "[1.2 m, 3 s]")),
            "scene.yaml:6: obstacles.wall.position[1] is '3 s', but 's' is not a unit of a length; write one of m, mm, cm, km");
}

TEST_F(Reader, SaysTheBounds) {
  EXPECT_EQ(error(replaced(good_scene, "  cell", "  cfl: 0.7\n  cell")),
            "scene.yaml:9: continuum.cfl is 0.7, out of bounds: it must be above 0 and at most 0.5");
  EXPECT_EQ(error(replaced(good_scene, "35 deg", "95 deg")),
            "scene.yaml:2: terrain.angle is 95 deg, out of bounds: it must be from 0 deg to 89 deg");
  EXPECT_EQ(error(replaced(good_scene, "1 s", "0 s")),
            "scene.yaml:12: duration is 0 s, out of bounds: it must be above 0 s and at most 1e+06 s");
}

TEST_F(Reader, SaysTheChoices) {
  EXPECT_EQ(error(replaced(good_scene, "coupled", "couplde")),
            "scene.yaml:1: mode is 'couplde', but must be one of continuum, coupled, grains; did you mean 'coupled'?");
  EXPECT_EQ(error(replaced(good_scene, "left: wall", "left: glass")),
            "scene.yaml:7: boundaries.left is 'glass', but must be one of wall, outflow, periodic, or a mapping with inflow");
  EXPECT_EQ(error(replaced(good_scene, "  diameter", "  zone: atuo\n  diameter")),
            "scene.yaml:11: grains.zone is 'atuo', but must be one of auto, or a mapping with x, y; did you mean 'auto'?");
}

TEST_F(Reader, RefusesNamesThatCannotBeUsed) {
  EXPECT_EQ(error(replaced(good_scene, "wall: {pos", "a/b: {pos")),
            "scene.yaml:6: obstacles.a/b has a name that cannot be used: 'a/b'; use up to 40 letters, digits, _ and -");
}

TEST_F(Reader, RefusesAKeyGivenTwice) {
  EXPECT_EQ(error(good_scene + "mode: grains\n"), "scene.yaml:13: mode is given twice, first at scene.yaml:1; keep one of them");
}

TEST_F(Reader, SaysWhereTheYamlBreaks) {
  const std::string what = error(replaced(good_scene, "width: 0.5 m}", "width: 0.5 m"));
  EXPECT_TRUE(what.starts_with("scene.yaml:")) << what;
  EXPECT_NE(what.find(": this is not YAML: "), std::string::npos) << what;
}

TEST_F(Reader, SaysThatThereIsNoFile) {
  try {
    read_scene("nowhere/scene.yaml", materials_folder);
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_STREQ(e.what(), "nowhere/scene.yaml: there is no such file; give a scene file, or a folder that holds scene.yaml");
  }
  EXPECT_EQ(error(""), "scene.yaml: the file cannot be read, or is empty; is it a text file with read permission?");
}

TEST_F(Reader, Overrides) {
  const Scene s = read(good_scene, {{"grains.seed", "7"}, {"obstacles.wall.size", "[10 mm, 200 mm, 60 mm]"}, {"mode", "grains"}});
  EXPECT_EQ(s.grains.seed, 7);
  EXPECT_EQ(s.obstacles[0].width, 0.2);
  EXPECT_EQ(s.mode, Mode::grains);
  EXPECT_EQ(read(good_scene, {{"obstacles", "{}"}, {"mode", "continuum"}}).obstacles.size(), 0u);
  EXPECT_EQ(read(good_scene, {{"grains.seed", "7"}, {"grains.seed", "8"}}).grains.seed, 8) << "the last one counts";
}

TEST_F(Reader, NamesTheWrongOverride) {
  EXPECT_EQ(error(good_scene, {{"grains.sed", "7"}}), "--set grains.sed: grains.sed is unknown; did you mean 'seed'?");
  EXPECT_EQ(error(good_scene, {{"grains.seed", "many"}}),
            "--set grains.seed: grains.seed is 'many', but must be a whole number, from 1 to 2147483647");
  EXPECT_EQ(error(good_scene, {{"grains.seed", "[1"}}).substr(0, 45), "--set grains.seed: '[1' is not a YAML value: ");
  EXPECT_EQ(error(good_scene, {{"grain.seed", "7"}}), "--set grain.seed: grain is unknown; did you mean 'grains'?");
  EXPECT_EQ(error(good_scene, {{"duration.long", "7"}}),
            "--set duration.long: duration is '1 s', not a mapping; set it whole: --set duration={long: ...}");
  EXPECT_EQ(error(good_scene, {{"grains..seed", "7"}}),
            "--set grains..seed: the key has an empty part; write it like grains.seed");
  EXPECT_EQ(error(good_scene, {{"", "7"}}), "--set : the key has an empty part; write it like grains.seed");
}

TEST_F(Reader, RefusesAnAliasThatHoldsItself) {
  EXPECT_NE(error("a: &a [*a]\n").find("does an alias (*name) hold itself?"), std::string::npos);
}

TEST_F(Reader, RefusesMoreRecordsThanCanBeMeant) {
  const std::string text = error(good_scene, {{"record.forces", "1e-12 s"}});
  EXPECT_NE(text.find("use at least"), std::string::npos) << text;
}

TEST_F(Reader, ShapesAndMethodsOfObstacles) {
  using enum ObstacleSpec::Shape;
  using enum ObstacleSpec::Method;
  const auto obstacle = [&](const std::string& more) {
    return read(replaced(good_scene, "80 mm]}", "80 mm]" + more + "}")).obstacles[0];
  };
  EXPECT_EQ(obstacle("").shape, cuboid);
  EXPECT_EQ(obstacle("").method, step);
  EXPECT_EQ(obstacle(", method: elevation").method, elevation);
  EXPECT_EQ(obstacle(", method: elevation, ramp: 4 mm").ramp, 0.004);
  const ObstacleSpec wedge = obstacle(", shape: tetrahedron");
  EXPECT_EQ(wedge.shape, tetrahedron);
  EXPECT_EQ(wedge.method, elevation) << "the shape decides where the scene says nothing";
  const Scene again = read(write_scene(read(replaced(good_scene, "80 mm]}", "80 mm], shape: tetrahedron}"))));
  EXPECT_EQ(again.obstacles[0].shape, tetrahedron);
  EXPECT_EQ(again.obstacles[0].method, elevation);
  const Scene ramp = read(write_scene(read(replaced(good_scene, "80 mm]}", "80 mm], method: elevation, ramp: 4 mm}"))));
  EXPECT_EQ(ramp.obstacles[0].ramp, 0.004);
}

// A name that is nobody's begins a body of its own, of which half is missing.
TEST_F(Reader, HalfABodyOfANameLikeAnothersIsASlip) {
  EXPECT_THAT(error(good_scene, {{"obstacles.wal.size", "[20 mm, 100 mm, 90 mm]"}}),
              ::testing::EndsWith("; or did you mean obstacles.wall?"));
}

}  // namespace
}  // namespace couloir
