// The keys of refined meshes: read, written, overridden, refused.

#include "coupling/scene/refine.hpp"

#include <gmock/gmock.h>

#include "scene_fixture.hpp"

namespace couloir {
namespace {

using ::testing::HasSubstr;
using Refine = SceneFixture;

const std::string continuum_scene = replaced(good_scene, "mode: coupled", "mode: continuum");
const std::string boxes = replaced(continuum_scene, "  cell: 10 mm\n",
                                   "  cell: 10 mm\n"                                                                       // 9
                                   "  refine:\n"                                                                           // 10
                                   "    - {around: wall, up: 100 mm, down: 20 mm, left: 30 mm, right: 0.04, levels: 2}\n"  // 11
                                   "    - {x: [0.2, 0.4], y: [-0.1, 50 mm], margin: 5 mm}\n");                             // 12

std::string with_refine(const std::string& entry) {
  return replaced(continuum_scene, "cell: 10 mm", "cell: 10 mm\n  refine: [" + entry + "]");
}

TEST_F(Refine, ReadsBoxes) {
  const Scene s = read(boxes);
  ASSERT_EQ(s.continuum.refine.size(), 2u);
  const RefineRectangle a = refine_rectangle(s, s.continuum.refine[0]), b = refine_rectangle(s, s.continuum.refine[1]);
  EXPECT_DOUBLE_EQ(a.x0, 1.1);
  EXPECT_DOUBLE_EQ(a.x1, 1.24);
  EXPECT_DOUBLE_EQ(a.y0, -0.08);
  EXPECT_DOUBLE_EQ(a.y1, 0.09);
  EXPECT_EQ(s.continuum.refine[0].levels, 2);
  EXPECT_EQ(b.x1, 0.4);
  EXPECT_EQ(b.y1, 0.05);
  EXPECT_EQ(s.continuum.refine[1].levels, 1);
  EXPECT_EQ(s.continuum.refine[1].margin, 0.005);
  EXPECT_TRUE(s.continuum.refined());
  EXPECT_FALSE(read(good_scene).continuum.refined());
}

TEST_F(Refine, DownCountsFromTheFrontWhereAsked) {
  const Scene s = read(with_refine("{around: wall, up: 10 mm, down: 30 mm, from: front}"));
  EXPECT_DOUBLE_EQ(refine_rectangle(s, s.continuum.refine[0]).x1, 1.23);
}

TEST_F(Refine, ScalesBareNumbers) {
  const Scene s = read("scales: {length: 0.1 m}\n" + with_refine("{around: wall, up: 1, down: 2 mm, margin: 0.5}"));
  EXPECT_DOUBLE_EQ(s.continuum.refine[0].up, 0.1);
  EXPECT_DOUBLE_EQ(s.continuum.refine[0].down, 0.002);
  EXPECT_DOUBLE_EQ(s.continuum.refine[0].margin, 0.05);
}

TEST_F(Refine, WritesWhatItReads) {
  const std::string adaptive =
      replaced(continuum_scene, "cell: 10 mm",
               "cell: 10 mm\n  block: 8\n  adapt: {levels: 3, front: off, gradient: 0.05, obstacle: 20 mm}");
  for (const std::string& text : {boxes, adaptive, with_refine("{around: wall, up: 1 mm, from: front}")}) {
    const Scene first = read(text);
    const std::string written = write_scene(first);
    const Scene second = read(written);
    EXPECT_EQ(write_scene(second), written);
    ASSERT_EQ(second.continuum.refine.size(), first.continuum.refine.size());
    for (std::size_t n = 0; n < first.continuum.refine.size(); ++n) {
      const RefineSpec &a = first.continuum.refine[n], &b = second.continuum.refine[n];
      EXPECT_EQ(b.around, a.around);
      EXPECT_EQ(b.up, a.up);
      EXPECT_EQ(b.right, a.right);
      EXPECT_EQ(b.from, a.from);
      EXPECT_EQ(b.x1, a.x1);
      EXPECT_EQ(b.y0, a.y0);
      EXPECT_EQ(b.levels, a.levels);
      EXPECT_EQ(b.margin, a.margin);
    }
    EXPECT_EQ(second.continuum.block, first.continuum.block);
    EXPECT_EQ(second.continuum.adapt.levels, first.continuum.adapt.levels);
    EXPECT_EQ(second.continuum.adapt.front, first.continuum.adapt.front);
    EXPECT_EQ(second.continuum.adapt.gradient, first.continuum.adapt.gradient);
    EXPECT_EQ(second.continuum.adapt.obstacle, first.continuum.adapt.obstacle);
    EXPECT_EQ(second.continuum.adapt.zone, first.continuum.adapt.zone);
  }
}

TEST_F(Refine, Overrides) {
  Scene s = read(continuum_scene,
                 {{"continuum.refine", "[{around: wall, up: 50 mm, levels: 2}]"}, {"continuum.refine[0].levels", "3"}});
  ASSERT_EQ(s.continuum.refine.size(), 1u);
  EXPECT_EQ(s.continuum.refine[0].levels, 3);
  EXPECT_EQ(read(boxes, {{"continuum.refine", "[]"}}).continuum.refine.size(), 0u);
  EXPECT_EQ(read(boxes, {{"obstacles.wall.size[1]", "150 mm"}}).obstacles[0].width, 0.15);
  s = read(continuum_scene, {{"continuum.adapt.levels", "2"}});
  EXPECT_EQ(s.continuum.adapt.levels, 2);
  EXPECT_EQ(s.continuum.adapt.interval, AdaptSpec().interval);
  EXPECT_EQ(read(continuum_scene, {{"continuum.adapt.levels", "2"}, {"continuum.adapt", "off"}}).continuum.adapt.levels, 0);
  EXPECT_EQ(error(boxes, {{"continuum.refine[2].levels", "3"}}),
            "--set continuum.refine[2].levels: continuum.refine has 2 entries, counted from 0; set it whole: --set "
            "'continuum.refine=[...]'");
  EXPECT_THAT(error(boxes, {{"continuum.refine[0].lvels", "3"}}),
              HasSubstr("continuum.refine[0].lvels is unknown; did you mean 'levels'?"));
}

TEST_F(Refine, SaysWhatAListTakes) {
  EXPECT_EQ(error(replaced(boxes, "up: 100 mm", "up: 100 kg")),
            "scene.yaml:11: continuum.refine[0].up is '100 kg', but 'kg' is not a unit of a length; write one of m, mm, cm, km");
  EXPECT_EQ(error(replaced(boxes, "margin", "magin")),
            "scene.yaml:12: continuum.refine[1].magin is unknown; did you mean 'margin'?");
  EXPECT_EQ(error(replaced(boxes, "levels: 2", "levels: 7")),
            "scene.yaml:11: continuum.refine[0].levels is 7, out of bounds: it must be from 1 to 6");
  EXPECT_EQ(error(with_refine("wall")),
            "scene.yaml:10: continuum.refine[0] is 'wall', but must be a mapping with around, up, down, left, right, from, x, y, "
            "levels, "
            "margin");
  EXPECT_THAT(error(continuum_scene, {{"continuum.refine", "{around: wall}"}}), HasSubstr("put it in brackets: [{...}]"));
  EXPECT_THAT(error(continuum_scene, {{"continuum.adapt", "{interval: 4}"}}), HasSubstr("continuum.adapt.levels is missing"));
}

TEST_F(Refine, RefusesBoxesThatAreNowhere) {
  EXPECT_EQ(error(replaced(boxes, "around: wall", "around: wal")),
            "scene.yaml:11: continuum.refine[0].around is 'wal', but no obstacle has that name; did you mean 'wall'?");
  EXPECT_THAT(error(boxes, {{"obstacles", "{}"}}), HasSubstr("is 'wall', but the scene has no obstacles; give x and y"));
  EXPECT_THAT(error(with_refine("{levels: 2}")), HasSubstr("continuum.refine[0] has no place; give around: <obstacle>, or x"));
  EXPECT_THAT(error(with_refine("{around: wall, x: [1, 2], y: [0, 0.1]}")),
              HasSubstr("has both an obstacle (around: wall) and x or y"));
  EXPECT_THAT(error(with_refine("{x: [1, 2], y: [0, 0.1], up: 1 mm}")), HasSubstr("which belong to around: <obstacle>"));
  EXPECT_THAT(error(with_refine("{x: [1.5, 1], y: [0, 0.1]}")), HasSubstr("is empty: x from 1.5 m to 1 m"));
  EXPECT_THAT(error(with_refine("{around: wall, from: front}")), HasSubstr("is empty: x from 1.2 m to 1.2 m"));
  EXPECT_EQ(error(with_refine("{x: [1.5, 2.5], y: [0, 0.1]}")),
            "scene.yaml:10: continuum.refine[0] covers x from 1.5 m to 2.5 m and y from 0 m to 100 mm, which reaches out of the "
            "domain (x "
            "from 0 to 2 m, y from -250 mm to 250 mm); give x and y within it");
  EXPECT_EQ(error(with_refine("{around: wall, up: 10, down: 10, left: 10, right: 10}")), "") << "about an obstacle it is cut off";
}

TEST_F(Refine, RefusesWhatNoSolverHas) {
  const Overrides noc = {{"continuum.scheme", "noc"}, {"obstacles.wall.method", "elevation"}};
  EXPECT_EQ(error(boxes, noc), "");
  EXPECT_THAT(error(continuum_scene, {noc[0], noc[1], {"continuum.adapt", "{levels: 1}"}}),
              HasSubstr("continuum.adapt belongs to scheme central_upwind: noc refines rectangles only"));
  EXPECT_THAT(error(continuum_scene, {noc[0], noc[1], {"continuum.block", "16"}}),
              HasSubstr("continuum.block belongs to scheme central_upwind"));
  const Overrides planes = {{"obstacles.wall.method", "planes"}};
  EXPECT_THAT(error(boxes, planes), HasSubstr("continuum.refine is not offered together with obstacles of method planes"));
  EXPECT_THAT(error(continuum_scene, {planes[0], {"continuum.adapt.levels", "1"}}), HasSubstr("continuum.adapt is not offered"));
  EXPECT_EQ(error(boxes, {{"mode", "grains"}}), "") << "a scene is the same in all modes";
  EXPECT_EQ(error(boxes, {{"mode", "coupled"}}), "");
}

TEST_F(Refine, BlocksFitTheLevels) {
  EXPECT_EQ(block_edge(read(continuum_scene)), 32);
  EXPECT_EQ(block_edge(read(boxes)), 16);
  EXPECT_EQ(block_edge(read(boxes, {{"continuum.block", "8"}})), 8);
  EXPECT_EQ(block_edge(read(with_refine("{around: wall, up: 1 mm, levels: 5}"))), 32);
  EXPECT_EQ(error(continuum_scene, {{"continuum.block", "7"}}), "") << "without refinement any will do";
  EXPECT_EQ(error(boxes, {{"continuum.block", "7"}}),
            "--set continuum.block: continuum.block is 7; with 2 levels of refinement it must be a multiple of 4");
  EXPECT_THAT(error(boxes, {{"continuum.block", "4"}, {"continuum.refine[0].levels", "3"}}), HasSubstr("a multiple of 8"));
}

TEST_F(Refine, RefusesMoreCellsThanAMeshMayHave) {
  const Scene s = read(boxes);
  const double base = 200 * 50;
  EXPECT_GT(estimated_cells(s), base);
  EXPECT_LT(estimated_cells(s), 5 * base);
  EXPECT_THAT(
      error(with_refine("{x: [0, 2], y: [-0.25, 0.25], levels: 6}")),
      HasSubstr("continuum.refine[0].levels is 6, which would make about 41 million cells, more than the 20 million allowed"));
  EXPECT_EQ(error(with_refine("{x: [0, 2], y: [-0.25, 0.25], levels: 5}")), "");
  EXPECT_EQ(error(continuum_scene, {{"continuum.adapt.levels", "6"}}), "");
  EXPECT_THAT(error(continuum_scene, {{"continuum.adapt.levels", "6"}, {"continuum.cell", "1.5 mm"}}),
              HasSubstr("continuum.adapt.levels is 6, which would make about"));
}

}  // namespace
}  // namespace couloir
