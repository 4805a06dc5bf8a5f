#include "scene_fixture.hpp"

namespace couloir {
namespace {

using Writer = SceneFixture;

TEST_F(Writer, ReadsBackWhatItWrites) {
  const std::string cases[] = {
      good_scene,
      "title: 'a \"quoted\" \\ title: #1'\n" + good_scene,
      replaced(good_scene, "  diameter",
               "  zone: {x: [1 m, 1.4 m], y: [-0.2, 0.2]}\n  timestep: 0.01 ms\n  skin: 1 mm\n  diameter"),
      replaced(good_scene, "left: wall, right: wall",
               "left: periodic, right: periodic, upstream: {inflow: {depth: 40 mm, velocity: 2}}"),
      replaced(good_scene, "kind: block, position: [0.1 m, 0], length: 300 mm, width: 200 mm, height: 100 mm",
               "kind: cap, centre: [0.3, 0.01], base_radius: 158 mm, height: 60 mm, mass: 1.41 kg"),
      replaced(good_scene, "kind: block, position: [0.1 m, 0], length: 300 mm, width: 200 mm, height: 100 mm",
               "kind: uniform, height: 60 mm, velocity: 1 m/s"),
      replaced(good_scene, "  cell", "  curvature: off\n  cell"),
      "scales: {length: 33.33 mm}\n" + good_scene,
      replaced(good_scene, "left: wall, right: wall",
               "upstream: {inflow: {kind: hydrograph, hydrograph: [[0, 0, 0], [1, 0.1, 0.3]]}}"),
      replaced(good_scene, "left: wall, right: wall", "upstream: {inflow: {kind: silo, gate: 18 mm}}"),
      good_scene + "record: {gauges: {one: {position: [1 m, 0.1]}, two: {position: [0.1, 0.1 m]}}}\n",
      replaced(good_scene, "80 mm]}\n",
               "80 mm], gauges: {a: {centre: [0, 40 mm], radius: 20 mm}, b: {centre: [35 mm, 60 mm], size: [30 mm, 40 mm]}}}\n"
               "  post: {position: [1.6 m, 0], size: [20 mm, 50 mm, 50 mm], gauges: {a: {centre: [0, 20 mm], radius: 8 mm}}}\n"),
      replaced(good_scene, "mode: coupled", "mode: continuum"),
      replaced(good_scene, "  diameter", "  rotation: blocked\n  diameter"),
      replaced(good_scene, "  diameter", "  rotation: {control: {retarding_time: 5 ms, slide_to_roll: 0.1}}\n  diameter"),
  };
  for (const std::string& text : cases) {
    const Scene first = read(text);
    const std::string written = write_scene(first);
    const Scene second = read(written);
    EXPECT_EQ(write_scene(second), written);
    EXPECT_EQ(second.title, first.title);
    EXPECT_EQ(second.mode, first.mode);
    EXPECT_EQ(second.terrain.angle, first.terrain.angle);
    EXPECT_EQ(second.material.phi, first.material.phi);
    EXPECT_EQ(second.material.grain.base_friction, first.material.grain.base_friction);
    EXPECT_EQ(second.material.calibration, first.material.calibration);
    EXPECT_EQ(second.material.source, first.material.source);
    EXPECT_EQ(second.release.kind, first.release.kind);
    EXPECT_EQ(second.release.x, first.release.x);
    EXPECT_EQ(second.release.mass, first.release.mass);
    EXPECT_EQ(second.obstacles.size(), first.obstacles.size());
    EXPECT_EQ(second.obstacles[0].height, first.obstacles[0].height);
    ASSERT_EQ(second.stress_gauges.size(), first.stress_gauges.size());
    for (std::size_t k = 0; k < first.stress_gauges.size(); ++k) {
      const StressGaugeSpec &a = first.stress_gauges[k], &b = second.stress_gauges[k];
      EXPECT_EQ(std::tie(a.name, a.obstacle, a.across, a.up, a.width, a.height, a.radius),
                std::tie(b.name, b.obstacle, b.across, b.up, b.width, b.height, b.radius));
    }
    EXPECT_EQ(second.sides[0].kind, first.sides[0].kind);
    EXPECT_EQ(second.sides[0].velocity, first.sides[0].velocity);
    ASSERT_EQ(second.sides[0].hydrograph.size(), first.sides[0].hydrograph.size());
    if (!first.sides[0].hydrograph.empty()) {
      EXPECT_EQ(second.sides[0].hydrograph[1].velocity, first.sides[0].hydrograph[1].velocity);
    }
    EXPECT_EQ(second.sides[0].gate, first.sides[0].gate);
    EXPECT_EQ(second.record.gauges.size(), first.record.gauges.size());
    EXPECT_EQ(second.continuum.curvature, first.continuum.curvature);
    EXPECT_EQ(second.grains.zones.size(), first.grains.zones.size());
    EXPECT_EQ(second.grains.timestep, first.grains.timestep);
    EXPECT_EQ(second.grains.skin, first.grains.skin);
    EXPECT_EQ(second.grains.rotation, first.grains.rotation);
    EXPECT_EQ(second.grains.control.retarding_time, first.grains.control.retarding_time);
    EXPECT_EQ(second.grains.control.slide_to_roll, first.grains.control.slide_to_roll);
    EXPECT_EQ(second.duration, first.duration);
  }
}

TEST_F(Writer, WritesEveryDefault) {
  const std::string written = write_scene(read(good_scene));
  for (const char* line :
       {"gravity: 9.81 m/s2", "  cfl: 0.45", "  seed: 20011", "  zone: auto", "  upstream: outflow", "    restitution: 0.5"}) {
    EXPECT_NE(written.find(std::string(line) + "\n"), std::string::npos) << line << " in\n" << written;
  }
}

TEST_F(Writer, ReadsEveryExperiment) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(COULOIR_SOURCE_DIR) + "/experiments")) {
    if (!std::filesystem::exists(entry.path() / "scene.yaml")) continue;
    ++scenes;
    const std::string written = write_scene(read_scene(entry.path().string(), materials_folder));
    EXPECT_EQ(write_scene(read(written)), written) << entry.path();
  }
  EXPECT_GE(scenes, 2);
}

}  // namespace
}  // namespace couloir
