#include "coupling/scene/check.hpp"

#include <gmock/gmock.h>

#include "scene_fixture.hpp"

namespace couloir {
namespace {

using Check = SceneFixture;

TEST_F(Check, PassesAGoodScene) {
  EXPECT_EQ(error(good_scene), "");
}

TEST_F(Check, StressGaugesLieOnAFaceApartFromOneAnother) {
  const std::string key = "obstacles.wall.gauges";
  const auto with = [&](const std::string& gauges, Overrides more = {}) {
    more.insert(more.begin(), {key, gauges});
    return error(good_scene, more);
  };
  const std::string at = "--set obstacles.wall.gauges: obstacles.wall.gauges.";
  EXPECT_EQ(with("{a: {centre: [0, 40 mm], radius: 20 mm}, b: {centre: [35 mm, 60 mm], size: [30 mm, 40 mm]}}"), "");
  EXPECT_EQ(with("{a: {centre: [0, 40 mm]}}"),
            at + "a has no extent; give size: [across, up] of a rectangle, or the radius of a round one");
  EXPECT_EQ(with("{a: {centre: [0, 40 mm], size: [20 mm, 20 mm], radius: 20 mm}}"),
            at + "a has a size and a radius; keep the size of a rectangle or the radius of a round one");
  EXPECT_EQ(with("{a: {centre: [0, 70 mm], size: [40 mm, 30 mm]}}"),
            at + "a covers -20 mm to 20 mm across and 55 mm to 85 mm up, which reaches out of the face of wall (-50 mm to 50 mm "
                 "across, 0 m "
                 "to 80 mm up)");
  EXPECT_EQ(with("{a: {centre: [0, 40 mm], size: [5.4 mm, 40 mm]}}"),
            at + "a is only 5.4 mm wide, less than the largest grain (5.5 mm): it would show single contacts and no stress; "
                 "enlarge it, or "
                 "use smaller grains");
  EXPECT_EQ(with("{a: {centre: [0, 40 mm], size: [5.4 mm, 40 mm]}}", {{"mode", "continuum"}}), "");
  EXPECT_EQ(with("{a: {centre: [0, 40 mm], size: [40 mm, 40 mm]}, b: {centre: [20 mm, 40 mm], size: [20 mm, 20 mm]}}"),
            at + "b overlaps gauge a of wall; move one of them");
  EXPECT_EQ(with("{a: {centre: [-10 mm, 30 mm], radius: 15 mm}, b: {centre: [15 mm, 50 mm], radius: 15 mm}}"),
            at + "b overlaps gauge a of wall (a round one is taken with the square around it); move one of them");
  EXPECT_EQ(with("{a: {centre: [0, 20.1 mm], size: [40 mm, 40 mm]}}"),
            at +
                "a has its outline at 0.1 mm up, only 0.1 mm beside an edge of the face: no mesh has triangles as thin; let both "
                "coincide, or keep 0.5 mm between them");
  EXPECT_EQ(
      with("{a: {centre: [-20 mm, 20 mm], size: [40 mm, 40 mm]}, b: {centre: [20.2 mm, 20 mm], size: [40 mm, 40 mm]}}"),
      at + "b has its outline at 0.2 mm across, only 0.2 mm beside an edge of gauge a: no mesh has triangles as thin; let both "
           "coincide, or keep 0.5 mm between them");
  EXPECT_EQ(with("{a: {centre: [-20 mm, 20 mm], size: [40 mm, 40 mm]}, b: {centre: [20 mm, 20 mm], size: [40 mm, 40 mm]}}"), "");
  EXPECT_EQ(
      error(good_scene, {{"obstacles.wedge",
                          "{shape: tetrahedron, position: [1.5 m, 0], size: [69 mm, 80 mm, 40 mm], gauges: "
                          "{a: {centre: [0, 20 mm], radius: 8 mm}}}"}}),
      "--set obstacles.wedge: obstacles.wedge.gauges.a is on a tetrahedron, which has no face across the flow; stress gauges "
      "belong to cuboids, so leave it out");
  EXPECT_THAT(with("{a: {centre: [0, 40 mm], radius: 0 mm}}"),
              testing::HasSubstr("obstacles.wall.gauges.a.radius is 0 mm, out of bounds"));
  EXPECT_THAT(with("{a: {radius: 20 mm}}"), testing::HasSubstr("obstacles.wall.gauges.a.centre is missing"));
  EXPECT_THAT(with("{a: {middle: [0, 0]}}"), testing::HasSubstr("obstacles.wall.gauges.a.middle is unknown"));
  EXPECT_THAT(with("[1]"), testing::HasSubstr("must be a mapping from names to mappings"));
}

TEST_F(Check, NocIsForTheContinuumAloneAndHasNoSteps) {
  EXPECT_EQ(error(good_scene, {{"continuum.scheme", "noc"}}),
            "--set continuum.scheme: continuum.scheme is noc, which runs in mode continuum only: it has no zone for grains; use "
            "central_upwind, or mode: continuum");
  EXPECT_EQ(
      error(good_scene, {{"continuum.scheme", "noc"}, {"mode", "continuum"}}),
      "scene.yaml:6: obstacles.wall is a step of the bed, which scheme noc cannot have: it knows obstacles by the bed's slope "
      "alone; use method: elevation, or continuum.scheme: central_upwind");
  EXPECT_EQ(error(good_scene, {{"continuum.scheme", "noc"}, {"mode", "continuum"}, {"obstacles", "{}"}}), "");
  EXPECT_THAT(error(good_scene, {{"continuum.cfl", "0.6"}}), testing::HasSubstr("continuum.cfl"));
}

TEST_F(Check, EnoIsForNocAlone) {
  EXPECT_EQ(error(good_scene, {{"continuum.limiter", "eno"}}),
            "--set continuum.limiter: continuum.limiter is eno, which scheme central_upwind does not have; use scheme: noc, or "
            "another limiter");
  EXPECT_EQ(
      error(good_scene, {{"continuum.limiter", "eno"}, {"continuum.scheme", "noc"}, {"mode", "continuum"}, {"obstacles", "{}"}}),
      "");
}

TEST_F(Check, YadeRunsOnOneRank) {
  EXPECT_EQ(error(good_scene, {{"grains.engine", "yade"}, {"grains.contact", "kelvin_voigt"}}), "");
  EXPECT_EQ(error(good_scene, {{"grains.engine", "yade"}, {"grains.ranks", "2"}}),
            "--set grains.ranks: grains.ranks is 2, but yade runs on one rank; leave it out, or use grains.engine: liggghts");
  EXPECT_EQ(error(good_scene, {{"grains.engine", "yade"}, {"grains.ranks", "2"}, {"mode", "continuum"}}), "");
  EXPECT_THAT(error(good_scene, {{"grains.engine", "yades"}}), testing::HasSubstr("yade"));
  EXPECT_THAT(error(good_scene, {{"grains.contact", "hooke"}}), testing::HasSubstr("hertz, kelvin_voigt"));
}

TEST_F(Check, EveryPackingHasASeed) {
  EXPECT_EQ(error(good_scene, {{"grains.seed", "2147483645"}, {"grains.replicates", "3"}}), "");
  EXPECT_EQ(error(good_scene, {{"grains.seed", "2147483646"}, {"grains.replicates", "3"}}),
            "--set grains.seed: grains.seed is 2147483646, but 3 packings have seeds from it upward, up to 2147483647 at most; "
            "lower it "
            "to 2147483645 or less");
  EXPECT_EQ(error(good_scene, {{"grains.seed", "2147483647"}}), "");
}

TEST_F(Check, UndampedContactsHaveALeastRestitution) {
  const Overrides off{{"grains.tangential_damping", "off"}};
  const auto with = [&](Overrides more) {
    more.insert(more.begin(), off.begin(), off.end());
    return error(good_scene, more);
  };
  EXPECT_EQ(with({}), "");
  EXPECT_EQ(with({{"grains.restitution", "0.22"}}), "");
  EXPECT_EQ(
      with({{"grains.restitution", "0.2"}}),
      "--set grains.tangential_damping: grains.tangential_damping is off where the restitution is 0.2: packings of both engines "
      "are settled by LIGGGHTS, whose hertz then takes no less than 0.22; raise the restitution, leave tangential_damping out, "
      "or "
      "use grains.contact: kelvin_voigt");
  EXPECT_EQ(with({{"grains.restitution", "0.2"}, {"grains.contact", "kelvin_voigt"}}), "");
  EXPECT_EQ(error(good_scene, {{"grains.restitution", "0.2"}}), "");
  EXPECT_THAT(error(good_scene, {{"grains.tangential_damping", "0.5"}}), testing::HasSubstr("off, on"));
}

TEST_F(Check, RotationControlAgreesWithItself) {
  const std::string control = "grains.rotation.control.";
  const Overrides given = {{control + "retarding_time", "5 ms"}};
  const auto with = [&](Overrides more) {
    more.insert(more.begin(), given.begin(), given.end());
    return error(good_scene, more);
  };
  EXPECT_EQ(with({}), "");
  EXPECT_EQ(with({{control + "slide_to_roll", "0.2 m/s"}, {control + "roll_to_slide", "0.05 m/s"}}), "");
  EXPECT_EQ(
      with({{control + "slide_to_roll", "0.2 m/s"}, {control + "roll_to_slide", "0.3 m/s"}}),
      "--set grains.rotation.control.roll_to_slide: grains.rotation.control.roll_to_slide is 0.3 m/s, above slide_to_roll, 0.2 "
      "m/s: a grain would stop its spin and start it again at once; lower it, or raise slide_to_roll");
  EXPECT_EQ(with({{control + "roll_to_slide", "0.3 m/s"}, {"mode", "continuum"}}), "");
  EXPECT_EQ(error(good_scene, {{"grains.rotation", "blocked"}}), "");
  EXPECT_EQ(error(good_scene, {{"grains.rotation", "control"}}),
            "--set grains.rotation: grains.rotation is 'control', but must be one of free, blocked, or a mapping with control");
  EXPECT_EQ(error(good_scene, {{"grains.rotation", "{}"}}),
            "--set grains.rotation: grains.rotation.control is missing: the law's parameters; the dissertation gives no values; "
            "give a mapping with retarding_time, contact_influence, shear_influence, slide_to_roll, roll_to_slide");
  EXPECT_THAT(error(good_scene, {{"grains.rotation", "{control: {contact_influence: 1}}"}}),
              testing::HasSubstr("grains.rotation.control.retarding_time is missing"));
  EXPECT_THAT(error(good_scene, {{control + "retarding_time", "0 s"}}), testing::HasSubstr("it must be above 0 s"));
  EXPECT_THAT(with({{control + "shear_influence", "2 s"}}), testing::HasSubstr("write one of s2/m, s^2/m"));
  EXPECT_THAT(with({{control + "retarding", "2 s"}}),
              testing::HasSubstr("grains.rotation.control.retarding is unknown; grains.rotation.control takes retarding_time"));
}

TEST_F(Check, ObstacleInTheDomain) {
  EXPECT_EQ(error(replaced(good_scene, "[1.2 m, 0]", "[1.99 m, 0]")),
            "scene.yaml:6: obstacles.wall covers x from 1.99 m to 2.01 m and y from -50 mm to 50 mm, which reaches out of the "
            "domain (x from 0 "
            "to 2 m, y from -250 mm to 250 mm)");
}

TEST_F(Check, GrainsHaveInflowsButNoPeriodicSlope) {
  for (const char* mode : {"coupled", "grains"})
    EXPECT_EQ(error(good_scene, {{"boundaries.upstream", "{inflow: {depth: 20 mm, velocity: 1 m/s}}"}, {"mode", mode}}), "");
  EXPECT_THAT(error(good_scene, {{"boundaries.upstream", "periodic"}, {"boundaries.downstream", "periodic"}, {"mode", "grains"}}),
              testing::HasSubstr("boundaries.upstream is periodic"));
}

TEST_F(Check, ObstacleApartFromReleaseAndOthers) {
  EXPECT_EQ(error(replaced(good_scene, "[1.2 m, 0]", "[0.3 m, 0]")),
            "scene.yaml:6: obstacles.wall stands in the release; move one of them");
  EXPECT_EQ(error(replaced(good_scene, "boundaries", "  post: {position: [1.21 m, 0], size: [20 mm, 20 mm, 80 mm]}\nboundaries")),
            "scene.yaml:7: obstacles.post overlaps obstacles.wall; move one of them");
}

TEST_F(Check, ObstacleNotThinnerThanACell) {
  EXPECT_EQ(error(replaced(good_scene, "[20 mm,", "[8 mm,")),
            "scene.yaml:6: obstacles.wall.size is 8 mm by 100 mm on the bed, thinner than a cell (10 mm), so that the mesh would "
            "not see it; use "
            "smaller cells");
  EXPECT_EQ(error(replaced(good_scene, "[20 mm,", "[8 mm,"), {{"mode", "grains"}}), "") << "without a mesh it does not matter";
}

TEST_F(Check, ReleaseInTheDomain) {
  EXPECT_EQ(error(replaced(good_scene, "[0.1 m, 0]", "[-0.1 m, 0]")),
            "scene.yaml:4: release covers x from -100 mm to 200 mm and y from -100 mm to 100 mm, which reaches out of the domain "
            "(x from 0 to 2 "
            "m, y from -250 mm to 250 mm)");
}

TEST_F(Check, CapAtMostAHemisphere) {
  EXPECT_EQ(error(replaced(good_scene, "kind: block, position: [0.1 m, 0], length: 300 mm, width: 200 mm, height: 100 mm",
                           "kind: cap, centre: [0.3, 0], base_radius: 100 mm, height: 110 mm")),
            "scene.yaml:4: release.height is 110 mm, more than the base radius 100 mm: the cap would overhang; lower it to a "
            "hemisphere at most");
}

TEST_F(Check, Mesh) {
  EXPECT_EQ(error(replaced(good_scene, "  cell: 10 mm", "  cfl: 0.4")),
            "scene.yaml:8: continuum.cell is missing: mode coupled needs the edge of a cell, a length such as 5 mm");
  EXPECT_EQ(error(replaced(good_scene, "cell: 10 mm", "cell: 0.1 mm")),
            "scene.yaml:9: continuum.cell is 0.1 mm, which makes 100 million cells, more than the 20 million allowed; use at "
            "least 0.223607 mm");
  EXPECT_EQ(error(replaced(good_scene, "cell: 10 mm", "cell: 0.6 m")),
            "scene.yaml:9: continuum.cell is 600 mm, too large for a domain of 2 m by 500 mm: it needs 4 cells along the slope "
            "and 1 across");
}

TEST_F(Check, GrainsWhereTheModeNeedsThem) {
  const std::string without = replaced(good_scene, "grains:\n  diameter: 5 mm\n", "");
  EXPECT_EQ(error(without),
            "scene.yaml: grains.diameter is missing: mode coupled needs a section grains with the diameter of a simulated grain; "
            "or use mode: "
            "continuum");
  EXPECT_EQ(error(without, {{"mode", "continuum"}}), "");
  EXPECT_EQ(error(replaced(good_scene, "continuum:\n  cell: 10 mm\n", ""), {{"mode", "grains"}}), "");
}

TEST_F(Check, GrainsSmallEnough) {
  EXPECT_EQ(error(replaced(good_scene, "height: 100 mm", "height: 5 mm")),
            "scene.yaml:11: grains.diameter is 5 mm, and with its spread larger than the flow's greatest depth 5 mm; use smaller "
            "grains");
  EXPECT_EQ(error(replaced(good_scene, "100 mm, 80 mm]", "100 mm, 8 mm]")),
            "scene.yaml:11: grains.diameter is 5 mm, too large for obstacles.wall (100 mm wide, 8 mm high): at most half of the "
            "smaller");
}

TEST_F(Check, ScaledDepthCounts) {
  // 0.02 kg of Vestolen on 300 mm by 200 mm is .52 mm deep.
  EXPECT_EQ(error(replaced(good_scene, "height: 100 mm", "height: 100 mm, mass: 0.02 kg")),
            "scene.yaml:11: grains.diameter is 5 mm, and with its spread larger than the flow's greatest depth 0.521648 mm; use "
            "smaller grains");
}

TEST_F(Check, AutomaticZoneNeedsAnObstacle) {
  EXPECT_EQ(error(good_scene, {{"obstacles", "{}"}}),
            "scene.yaml:10: grains.zone is auto, but there is no obstacle to put it around; give a box {x: [.., ..], y: [.., "
            "..]} or an obstacle");
}

TEST_F(Check, Zone) {
  const auto with = [&](const std::string& box) { return error(good_scene, {{"grains.zone", box}}); };
  const std::string at = "--set grains.zone: ";
  EXPECT_EQ(with("{x: [1, 1.4], y: [-0.2, 0.2]}"), "");
  EXPECT_EQ(with("{x: [1, 2.4], y: [-0.2, 0.2]}"),
            at + "grains.zone reaches out of the domain (x from 0 to 2 m, y from -250 mm to 250 mm)");
  EXPECT_EQ(with("{x: [1.4, 1], y: [-0.2, 0.2]}"),
            at + "grains.zone is empty: x from 1.4 m to 1 m, y from -200 mm to 200 mm; give [from, to] with from below to");
  EXPECT_EQ(
      with("{x: [1, 1.21], y: [-0.2, 0.2]}"),
      at + "grains.zone cuts through obstacles.wall (x from 1.2 m to 1.22 m, y from -50 mm to 50 mm); it must hold it whole");
  EXPECT_EQ(with("{x: [1.4, 1.8], y: [-0.2, 0.2]}"),
            at + "grains.zone holds none of the scene's obstacles; move it, or use zone: auto");
  EXPECT_EQ(with("{x: [1.19, 1.4], y: [-0.2, 0.2]}"), at + "grains.zone is too tight around obstacles.wall: it needs 5 grain "
                                                           "diameters (25 mm) before it and 2 beside and behind it");
  EXPECT_EQ(with("{x: [1, 1.02], y: [-0.2, 0.2]}"),
            at + "grains.zone is 20 mm by 400 mm, too small for grains of 5 mm: at least 5 diameters along and 2 across");
  EXPECT_EQ(error(good_scene, {{"grains.zone", "{x: [0.01, 1.4], y: [-0.2, 0.2]}"}}),
            at + "grains.zone.x starts at 10 mm: upstream of the zone the driven layer of grains needs 3 diameters (15 mm)");
}

TEST_F(Check, SeveralZonesKeepClearOfEachOther) {
  const auto with = [&](const std::string& boxes) { return error(good_scene, {{"grains.zones", boxes}}); };
  const std::string first = "{x: [1, 1.4], y: [-0.2, 0.2]}", at = "--set grains.zones: grains.zones";
  EXPECT_EQ(with("[" + first + ", {x: [1.6, 1.8], y: [-0.2, 0.2]}]"), "");
  EXPECT_EQ(
      with("[" + first + ", {x: [1.5, 1.8], y: [-0.2, 0.2]}]"),
      at + "[1] is only 100 mm from grains.zones[0]: zones need 30 grain diameters (150 mm) between them; move them apart, or "
           "give one box around both");
  EXPECT_EQ(with("[" + first + ", {x: [1.3, 1.8], y: [-0.2, 0.2]}]"),
            at + "[1] is no way from grains.zones[0]: zones need 30 grain diameters (150 mm) between them; move them apart, or "
                 "give one box around both");
  EXPECT_EQ(with("[" + first + ", {x: [1.6, 2.8], y: [-0.2, 0.2]}]"),
            at + "[1] reaches out of the domain (x from 0 to 2 m, y from -250 mm to 250 mm)");
  const std::string both = "{diameter: 5 mm, zone: " + first + ", zones: [{x: [1.6, 1.8], y: [-0.2, 0.2]}]}";
  EXPECT_EQ(error(good_scene, {{"grains", both}}),
            "--set grains: grains.zones gives boxes, and grains.zone one more; put them all into grains.zones");
  EXPECT_EQ(read(good_scene, {{"grains", both}, {"grains.zone", "auto"}}).grains.zones.size(), 0u) << "what is set last counts";
  EXPECT_EQ(read(good_scene, {{"grains.zone", "auto"}, {"grains.zones", "[" + first + "]"}}).grains.zones.size(), 1u);
  EXPECT_EQ(
      error(good_scene, {{"boundaries", "{left: periodic, right: periodic}"},
                         {"grains.zones", "[{x: [1, 1.4], y: [-0.25, -0.1]}, {x: [1, 1.4], y: [0.1, 0.25]}]"},
                         {"obstacles", "{}"}}),
      at + "[1] is no way from grains.zones[0]: zones need 30 grain diameters (150 mm) between them, also across periodic sides; "
           "move them apart, or give one box around both");
  EXPECT_EQ(with("[]"), "") << "automatic";
}

TEST_F(Check, Profile) {
  const auto with = [&](const std::string& rows) {
    return error(good_scene, {{"terrain", "{kind: profile, width: 0.5 m, profile: " + rows + "}"}});
  };
  const std::string at = "--set terrain: terrain.profile";
  EXPECT_EQ(with("[[0, 35 deg], [1.4 m, 35 deg], [1.6 m, 10 deg], [2 m, -5 deg]]"), "");
  EXPECT_EQ(with("[[0, 35 deg]]"), at + " has 1 row; give at least 2");
  EXPECT_EQ(with("[[0.1, 35 deg], [2 m, 35 deg]]"), at + " begins at 100 mm; its first row must be at x = 0");
  EXPECT_EQ(with("[[0, 35 deg], [1.6 m, 35 deg], [1.4 m, 10 deg]]"), at + " has a row at 1.4 m after one at 1.6 m; x must rise");
  EXPECT_EQ(with("[[0, 35 deg], [2 m, 90 deg]]"), at + " has an angle of 90 deg at x = 2 m; give one from -89 to 89 deg");
  EXPECT_EQ(with("[[0, 60 deg], [2 m, -40 deg]]"),
            at + " turns from -40 deg to 60 deg; a terrain's angles must lie within 90 deg of each other");
  EXPECT_EQ(
      with("[[0, 35 deg], [1.4 m, 35 deg], [1.42 m, 5 deg], [2 m, 5 deg]]"),
      at + " has an arc at x = 1.4 m of 20 mm, a radius of 38.1972 mm, no larger than the flow's greatest depth 100 mm: depths "
           "are measured along normals, which meet inside such a flow; use a longer arc");
  EXPECT_THAT(with("[[0, 0.6], [2 m, 30 deg]]"), testing::HasSubstr("unit"));
  EXPECT_EQ(error(good_scene, {{"mode", "continuum"},
                               {"terrain", "{kind: profile, width: 0.5 m, profile: [[0, 30 deg], [2 m, 35 deg]]}"},
                               {"boundaries", "{upstream: periodic, downstream: periodic}"}}),
            "--set boundaries: boundaries.upstream is periodic on a profile with arcs; use wall or outflow");
}

TEST_F(Check, PeriodicSidesInPairs) {
  EXPECT_EQ(error(replaced(good_scene, "left: wall", "left: periodic")),
            "scene.yaml:7: boundaries.left is periodic, but boundaries.right is not; periodic sides come in pairs");
  EXPECT_EQ(error(replaced(good_scene, "right: wall", "right: periodic")),
            "scene.yaml:7: boundaries.right is periodic, but boundaries.left is not; periodic sides come in pairs");
  EXPECT_EQ(
      error(replaced(good_scene, "kind: incline, angle: 35 deg, length: 2 m",
                     "kind: chute, angle: 35 deg, slope: 1, arc: 0.5, runout: 0.5"),
            {{"boundaries", "{upstream: periodic, downstream: periodic}"}}),
      "--set boundaries: boundaries.upstream is periodic on a chute, whose ends have different slopes; use wall or outflow");
}

TEST_F(Check, ContinuumMayStartOnAnObstacle) {
  EXPECT_EQ(error(replaced(good_scene, "[1.2 m, 0]", "[0.3 m, 0]"), {{"mode", "continuum"}}), "");
}

TEST_F(Check, ArcNotTighterThanTheFlowIsDeep) {
  const auto chute = [](const std::string& arc) {
    return replaced(good_scene, "kind: incline, angle: 35 deg, length: 2 m",
                    "kind: chute, angle: 35 deg, slope: 1.25 m, arc: " + arc + ", runout: 0.5 m");
  };
  EXPECT_EQ(error(chute("70 mm")), "");
  EXPECT_EQ(error(chute("60 mm")),
            "scene.yaml:2: terrain.arc is 60 mm, a radius of 98.2213 mm, no larger than the flow's greatest depth 100 mm: depths "
            "are measured along normals, which meet inside such a flow; use a longer arc");
  const std::string on_arc = replaced(good_scene, "kind: incline, angle: 35 deg, length: 2 m",
                                      "kind: chute, angle: 35 deg, slope: 0.3 m, arc: 0.11 m, runout: 1.6 m");
  EXPECT_EQ(error(on_arc),
            "scene.yaml:4: release is up to 100 mm deep on an arc of radius 180.072 mm: at most half of the radius, beyond which "
            "volumes on the arc are off by more than a quarter; move it up, or use a longer arc");
}

TEST_F(Check, PassivePressureWithinReason) {
  EXPECT_EQ(error(good_scene, {{"material.internal_friction_angle", "60 deg"}}), "");
  EXPECT_THAT(error(good_scene, {{"material.internal_friction_angle", "70 deg"}}),
              testing::HasSubstr(
                  "material.internal_friction_angle is 70 deg, which makes a passive earth pressure coefficient of 32: above 20 "
                  "the flow would gain energy; lower it, or use continuum.closure: hydraulic"));
  EXPECT_EQ(error(good_scene, {{"material.internal_friction_angle", "70 deg"}, {"continuum.closure", "hydraulic"}}), "");
}

TEST_F(Check, BasalAngleBelowInternal) {
  EXPECT_EQ(error(good_scene, {{"material.basal_friction_angle", "38 deg"}}),
            "--set material.basal_friction_angle: material.basal_friction_angle is 38 deg, above the internal friction angle 37 "
            "deg: (2.83) has no "
            "real K; lower it, or use continuum.closure: hydraulic");
  EXPECT_EQ(error(good_scene, {{"material.basal_friction_angle", "38 deg"}, {"continuum.closure", "hydraulic"}}), "");
}

TEST_F(Check, ElevationOfObstacles) {
  const auto wall = [](const std::string& more) { return replaced(good_scene, "80 mm]}", "80 mm], " + more + "}"); };
  EXPECT_EQ(error(wall("method: elevation, ramp: 10 mm")), "");
  EXPECT_EQ(error(wall("method: elevation, ramp: 11 mm")),
            "scene.yaml:6: obstacles.wall.ramp is 11 mm, more than half of the base's shorter edge (20 mm); shorten it");
  EXPECT_EQ(error(wall("ramp: 5 mm")), "scene.yaml:6: obstacles.wall.ramp does not belong to method 'step'; it is for elevation");
  EXPECT_EQ(
      error(wall("shape: tetrahedron, method: step")),
      "scene.yaml:6: obstacles.wall.method is step, but a tetrahedron has no upright sides; use elevation, or leave it out");
  EXPECT_EQ(error(wall("shape: tetrahedron, ramp: 5 mm")),
            "scene.yaml:6: obstacles.wall.ramp belongs to a cuboid; a tetrahedron's faces are given by its size; leave it out");
  EXPECT_EQ(error(wall("shape: tetraedron")),
            "scene.yaml:6: obstacles.wall.shape is 'tetraedron', but must be one of cuboid, tetrahedron, mesh; did you mean "
            "'tetrahedron'?");
}

}  // namespace
}  // namespace couloir
