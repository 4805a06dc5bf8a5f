// An obstacle from an STL file in the three modes. A cuboid that is written as one must be the cuboid.

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <fstream>

#include "../scene/body_meshes.hpp"
#include "coupling/loop/meshes.hpp"
#include "coupling/plan/build.hpp"
#include "small_run.hpp"

namespace couloir {
namespace {

// small_scene() with its wall from a file, in mm.
Scene with_body(const std::string& mode, const std::vector<BodyTriangle>& triangles, Overrides more = {}) {
  const std::string file = fresh_folder("stl_of_" + mode) + "/wall.stl";
  std::ofstream(file) << stl_text(triangles);
  more.insert(more.begin(), {"obstacles.wall", "{shape: mesh, position: [400 mm, 0], file: '" + file + "'}"});
  return small_scene(mode, more);
}

const std::vector<BodyTriangle> wall = box(0, 10, 0, 60, 0, 40);  // tests/scenes/small_wall.yaml has it as a cuboid

Vec impulse(const Watched& run) {
  Vec sum{};
  for (const WindowReport& w : run.windows)
    for (int k = 0; k < 3; ++k) sum[k] += w.obstacles[0].force[k] * w.length;
  return sum;
}

TEST(MeshObstacle, AStepFromAFileIsTheCuboidBitByBit) {
  const Watched cuboid = watch(small_scene("continuum"), options_in(fresh_folder("cuboid")));
  const Watched mesh = watch(with_body("continuum", wall), options_in(fresh_folder("mesh")));
  ASSERT_EQ(mesh.windows.size(), cuboid.windows.size());
  EXPECT_EQ(mesh.frames, cuboid.frames);
  EXPECT_GT(impulse(cuboid)[0], 0.05);
  for (std::size_t k = 0; k < mesh.windows.size(); ++k) {
    ASSERT_EQ(mesh.windows[k].obstacles[0].force, cuboid.windows[k].obstacles[0].force);
    ASSERT_EQ(mesh.windows[k].obstacles[0].depth_on_top, cuboid.windows[k].obstacles[0].depth_on_top);
    ASSERT_EQ(mesh.windows[k].overtopped, cuboid.windows[k].overtopped);
  }
}

// A frustum is what a cuboid by elevation is: the same bed to the round-off of planes through three corners.
TEST(MeshObstacle, AnElevationFromAFileIsThatOfTheCuboid) {
  std::vector<BodyTriangle> frustum = box(0, 40, 0, 60, 0, 40);
  for (BodyTriangle& t : frustum)
    for (BodyPoint& p : t)
      if (p[2] == 40) p = {p[0] == 0 ? 15. : 25., p[1] == 0 ? 15. : 45., 40};
  const Scene cuboid = small_scene("continuum", {{"obstacles.wall.method", "elevation"},
                                                 {"obstacles.wall.ramp", "15 mm"},
                                                 {"obstacles.wall.size", "[40 mm, 60 mm, 40 mm]"}});
  const Scene mesh = with_body("continuum", frustum, {{"obstacles.wall.method", "elevation"}});
  const StepBed a = step_bed(cuboid), b = step_bed(mesh);
  EXPECT_EQ(a.owner, b.owner);
  EXPECT_GT(*std::ranges::max_element(a.elevation), 0.03);
  for (std::size_t c = 0; c < a.elevation.size(); ++c) ASSERT_NEAR(a.elevation[c], b.elevation[c], 1e-12) << c;
  const Watched one = watch(cuboid, options_in(fresh_folder("cuboid_elevation")));
  const Watched other = watch(mesh, options_in(fresh_folder("mesh_elevation")));
  const Vec p = impulse(one), q = impulse(other);
  EXPECT_GT(p[0], 0.02);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(p[k], q[k], 1e-9 * p[0]);
}

TEST(MeshObstacle, ItsTrianglesStandOnTheTangentPlaneAsACuboidDoes) {
  const auto surface = ReferenceSurface::chute(0.7, 0.3, 0.2, 0.5);
  const Scene mesh = with_body("grains", wall), cuboid = small_scene("grains");
  const auto corners = [&](const Scene& s, double size) {
    std::vector<std::array<long, 3>> out;  // [nm]
    for (const Triangle& t : obstacle_mesh(surface, s.obstacles[0], size).rest)
      for (const Vec* p : {&t.a, &t.b, &t.c})
        out.push_back({std::lround((*p)[0] * 1e9), std::lround((*p)[1] * 1e9), std::lround((*p)[2] * 1e9)});
    std::ranges::sort(out);
    out.erase(std::ranges::unique(out).begin(), out.end());
    return out;
  };
  EXPECT_EQ(corners(mesh, 1).size(), 8u);
  EXPECT_EQ(corners(mesh, 1), corners(cuboid, 1));
  for (const Triangle& t : obstacle_mesh(surface, mesh.obstacles[0], 0.03).rest) {
    const Eigen::Vector3d a(t.a[0], t.a[1], t.a[2]), b(t.b[0], t.b[1], t.b[2]), c(t.c[0], t.c[1], t.c[2]);
    EXPECT_LT(std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()}), 0.03 * (1 + 1e-9));
  }
}

// Other triangles change the last bits of contacts, and grains make two realisations of that: as far apart as two packings.
TEST(MeshObstacle, GrainsMeetTheSameBody) {
  const Overrides shorter{{"duration", "0.2 s"}};
  const Watched cuboid = watch(small_scene("grains", shorter), options_in(fresh_folder("cuboid_grains")));
  const Watched mesh = watch(with_body("grains", wall, shorter), options_in(fresh_folder("mesh_grains")));
  const auto first = [](const Watched& run) {
    return std::ranges::find_if(run.windows, [](const WindowReport& w) { return w.obstacles[0].force[0] != 0; }) -
           run.windows.begin();
  };
  ASSERT_LT(first(cuboid), long(cuboid.windows.size()));
  EXPECT_EQ(first(mesh), first(cuboid));
  const auto a = cuboid.windows[first(cuboid)].obstacles[0].force, b = mesh.windows[first(mesh)].obstacles[0].force;
  std::printf("first contact: %.15g and %.15g N; impulse %.6f and %.6f N s\n", a[0], b[0], impulse(cuboid)[0], impulse(mesh)[0]);
  EXPECT_NEAR(b[0], a[0], 1e-6 * std::abs(a[0]));
  EXPECT_NEAR(impulse(mesh)[0], impulse(cuboid)[0], 0.05 * impulse(cuboid)[0]);
}

TEST(MeshObstacle, ADamInTheZone) {
  const Scene scene = with_body("coupled", half_ring(22, 30, 30, 10), {{"obstacles.wall.position", "[395 mm, 0]"}});
  const Watched run = watch(scene, options_in(fresh_folder("dam")));
  ASSERT_EQ(run.end.status, "done");
  double residual = 0;
  for (const WindowReport& w : run.windows) {
    ASSERT_LE(w.mass.relative_error(), 1e-12) << "at " << w.time;
    if (w.momentum.scale > 0) residual = std::max(residual, std::abs(w.momentum.residual) / w.momentum.scale);
  }
  EXPECT_LT(residual, 0.02);
  EXPECT_GT(impulse(run)[0], 0.05);
  EXPECT_GT(run.windows.back().inserted, 500);
}

}  // namespace
}  // namespace couloir
