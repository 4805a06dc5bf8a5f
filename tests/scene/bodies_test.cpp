#include "coupling/scene/bodies.hpp"

#include <gmock/gmock.h>

#include "body_meshes.hpp"
#include "scene_fixture.hpp"

namespace couloir {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Bodies : public SceneFixture {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  void write(const std::string& name, const std::vector<BodyTriangle>& triangles) const { write(name, stl_text(triangles)); }
};

const std::string with_dam =
    replaced(good_scene, "size: [20 mm, 100 mm, 80 mm]}", "shape: mesh, file: dam.stl, rotation: 180 deg}");

TEST_F(Bodies, AnStlFileBesideTheSceneBecomesTheObstacle) {
  write("dam.stl", box(0, 20, 0, 100, 0, 80));
  const Scene scene = read(with_dam);
  const ObstacleSpec& o = scene.obstacles[0];
  EXPECT_NEAR(o.length, 0.02, 1e-15);
  EXPECT_NEAR(o.width, 0.1, 1e-15);
  EXPECT_EQ(o.height, 0.08);
  EXPECT_EQ(o.method, ObstacleSpec::Method::step);
  EXPECT_TRUE(o.covers(1.21, 0.049));
  EXPECT_FALSE(o.covers(1.19, 0));
  EXPECT_NEAR(o.base_area(), 0.002, 1e-15);
  EXPECT_NEAR(o.crest_x(), 1.21, 1e-12);
  EXPECT_NEAR(o.crest_width(), 0.1, 1e-12);
  EXPECT_EQ(read(with_dam, {{"obstacles.wall.unit", "m"},
                            {"mode", "continuum"},
                            {"continuum.cell", "0.5 m"},
                            {"obstacles.wall.position", "[0, 0]"},
                            {"terrain.length", "200 m"},
                            {"terrain.width", "200 m"}})
                .obstacles[0]
                .height,
            80);
}

// A run's folder holds the scene and nothing else of its origin.
TEST_F(Bodies, AWrittenSceneNeedsNoFile) {
  write("dam.stl", half_ring(90.5, 111.3, 80.1, 12));
  const Scene first = read(with_dam);
  const std::string written = write_scene(first);
  std::filesystem::remove(folder_ / "dam.stl");
  EXPECT_THAT(error(with_dam), HasSubstr("does not exist"));
  const Scene second = read(written);
  EXPECT_EQ(write_scene(second), written);
  EXPECT_EQ(second.obstacles[0].vertices, first.obstacles[0].vertices);
  EXPECT_EQ(second.obstacles[0].faces, first.obstacles[0].faces);
  EXPECT_EQ(second.obstacles[0].body->triangles(), first.obstacles[0].body->triangles());
  EXPECT_EQ(second.obstacles[0].file, "dam.stl");  // where it came from
}

TEST_F(Bodies, SaysWhatIsWrongWithAFile) {
  const std::string at = "scene.yaml:6: obstacles.wall.file (dam.stl) ";
  EXPECT_EQ(error(with_dam), at + "does not exist; give the path of an STL file");
  write("dam.stl", std::string("mesh { }"));
  EXPECT_THAT(error(with_dam), StartsWith(at + "is no STL file: line 1 has 'mesh' where solid should come"));
  auto open = box(0, 20, 0, 100, 0, 80);
  open.erase(open.begin());
  write("dam.stl", open);
  EXPECT_THAT(error(with_dam), StartsWith(at + "is open: 3 edges have no triangle on the other side, one from [0 m, 0 m, 0 m]"));
  write("dam.stl", box(0, 20, 0, 100, 12, 80));
  EXPECT_EQ(error(with_dam), at + "has no base on the bed: its lowest point is at z = 12 mm, the bed is at 0; move it down");
  write("dam.stl", box(0, 20, 0, 100, -80, 0));
  EXPECT_EQ(error(with_dam), at + "has nothing above the bed, z = 0: its lowest point is at -80 mm; move it up");
  write("dam.stl", std::vector<BodyTriangle>{{{{0, 0, 0}, {0, 10, 20}, {20, 10, 20}}},
                                             {{{0, 0, 0}, {20, 10, 20}, {0, -10, 20}}},
                                             {{{0, 0, 0}, {0, -10, 20}, {0, 10, 20}}},
                                             {{{0, 10, 20}, {0, -10, 20}, {20, 10, 20}}}});
  EXPECT_THAT(error(with_dam), StartsWith(at + "has no base on the bed: it touches z = 0 with a point or an edge only"));
  write("dam.stl", box(0, 20, 0, 100, 0, 80));
  EXPECT_EQ(
      error(with_dam, {{"obstacles.wall.position", "[1.99 m, 0]"}}),
      "scene.yaml:6: obstacles.wall covers x from 1.99 m to 2.01 m and y from -50 mm to 50 mm, which reaches out of the domain "
      "(x from 0 to 2 m, y from -250 mm to 250 mm)");
  EXPECT_THAT(error(with_dam, {{"obstacles.wall.unit", "m"}}), HasSubstr("which reaches out of the domain"));
}

TEST_F(Bodies, SaysWhatIsWrongWithItsKeys) {
  write("dam.stl", box(0, 20, 0, 100, 0, 80));
  EXPECT_EQ(error(with_dam), "");
  EXPECT_EQ(
      error(replaced(with_dam, "file: dam.stl, ", "")),
      "scene.yaml:6: obstacles.wall is of shape mesh, but has no file; give the path of an STL file, from the scene's folder");
  EXPECT_THAT(error(with_dam, {{"obstacles.wall.size", "[1, 1, 1]"}}),
              HasSubstr("obstacles.wall.size does not belong to shape 'mesh'; it is for cuboid, tetrahedron"));
  EXPECT_THAT(error(with_dam, {{"obstacles.wall.unit", "inch"}}), HasSubstr("one of mm, cm, m"));
  EXPECT_THAT(error(with_dam, {{"obstacles.wall.method", "planes"}}), HasSubstr("is planes, which only a cuboid has"));
  EXPECT_THAT(error(with_dam, {{"obstacles.wall.gauges", "{a: {centre: [0, 40 mm], radius: 20 mm}}"}}),
              HasSubstr("gauges.a is on a mesh, which has no face across the flow"));
  EXPECT_THAT(error(with_dam, {{"obstacles.wall.vertices", "[[0, 0, 0]]"}}), HasSubstr("obstacles.wall.vertices comes alone"));
  EXPECT_THAT(error(with_dam, {{"obstacles.wall.vertices", "[[0, 0, 0]]"}, {"obstacles.wall.faces", "[[0, 1, 2]]"}}),
              HasSubstr("obstacles.wall.faces names vertex 1 in row 1; there are 1, counted from 0"));
  // Long and thin: an engine refuses such triangles.
  std::vector<BodyTriangle> thin = prism({{0, 0}, {20, 0}, {20, 0.02}, {20, 100}, {0, 100}}, 0, 80);
  write("dam.stl", thin);
  EXPECT_THAT(error(with_dam), HasSubstr("so thin that the engine refuses them: at least 0.5 deg"));
  EXPECT_EQ(error(with_dam, {{"mode", "continuum"}}), "");
}

TEST_F(Bodies, AnObstacleMayStandInTheBoxAroundAnother) {
  write("dam.stl", half_ring(90, 110, 80, 24));
  const std::string post = "{position: [1.23 m, 0], size: [20 mm, 20 mm, 40 mm]}";
  const Overrides inside{{"obstacles.wall.rotation", "0 deg"}, {"obstacles.post", post}};
  EXPECT_EQ(error(with_dam, inside), "");
  EXPECT_THAT(error(with_dam, {{"obstacles.wall.rotation", "180 deg"},
                               {"obstacles.post", "{position: [1.2 m, 0], size: [20 mm, 20 mm, 40 mm]}"}}),
              HasSubstr("overlaps obstacles.wall"));
}

}  // namespace
}  // namespace couloir
