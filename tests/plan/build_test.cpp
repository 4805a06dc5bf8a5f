#include "coupling/plan/build.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/plan/stiffness.hpp"
#include "coupling/scene/release_shape.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

TEST(Build, GridOfTheWall) {
  const Grid g = grid_of(experiment("chiou_wall"));
  EXPECT_EQ(g.nx, 383);
  EXPECT_EQ(g.ny, 160);
  EXPECT_DOUBLE_EQ(g.nx * g.dx, 1.915);
  EXPECT_NEAR(g.ny * g.dy, 0.8, 1e-12);
  EXPECT_EQ(g.x0, 0);
}

TEST(Build, RowsAreMirroredToTheBit) {
  for (const char* width : {"0.8 m", "0.7 m", "333 mm", "0.1234567 m"}) {
    const Scene s = experiment("chiou_wall", {{"terrain.width", width},
                                              {"mode", "continuum"},
                                              {"continuum.cell", "3 mm"},
                                              {"release.base_radius", "60 mm"},
                                              {"release.mass", "0.1 kg"},
                                              {"obstacles.wall.size", "[10 mm, 50 mm, 80 mm]"}});
    const Grid g = grid_of(s);
    EXPECT_EQ(g.ny % 2, 0);
    EXPECT_NEAR(g.ny * g.dy / s.terrain.width, 1, 1e-12);
    for (int j = 0; j < g.ny; ++j) ASSERT_EQ(g.y(j), -g.y(g.ny - 1 - j)) << width << " row " << j;
  }
}

TEST(Build, NarrowDomainIsOneRow) {
  const auto rows = [](const char* across, const char* mode) {
    return grid_of(experiment("flume_continuum", {{"continuum.cell_across", across},
                                                  {"mode", mode},
                                                  {"grains", "{diameter: 5 mm, zone: {x: [1 m, 1.5 m], y: [-0.1, 0.1]}}"}}));
  };
  const Grid one = rows("0.3 m", "continuum");
  EXPECT_EQ(one.ny, 1);
  EXPECT_NEAR(one.dy, 0.3, 1e-12);
  EXPECT_EQ(one.y(0), 0);
  EXPECT_EQ(rows("0.21 m", "continuum").ny, 1);
  EXPECT_EQ(rows("0.19 m", "continuum").ny, 2);
  EXPECT_EQ(rows("0.3 m", "coupled").ny, 2);
}

TEST(Build, SolverSettings) {
  const Scene s = experiment("chiou_wall", {{"continuum.limiter", "mc"},
                                            {"continuum.cfl", "0.3"},
                                            {"boundaries.upstream", "{inflow: {depth: 30 mm, velocity: 2 m/s}}"},
                                            {"boundaries.left", "wall"}});
  const SolverSettings settings = solver_settings(s);
  EXPECT_EQ(settings.limiter, Limiter::mc);
  EXPECT_EQ(settings.cfl, 0.3);
  EXPECT_EQ(settings.gravity, 9.81);
  EXPECT_EQ(settings.sides[0].kind, Side::Kind::inflow);
  EXPECT_EQ(settings.sides[0].depth, 0.03);
  EXPECT_EQ(settings.sides[0].velocity, 2);
  EXPECT_EQ(settings.sides[1].kind, Side::Kind::outflow);
  EXPECT_EQ(settings.sides[2].kind, Side::Kind::wall);
  EXPECT_DOUBLE_EQ(settings.closure.tan_delta, std::tan(24 * std::numbers::pi / 180));
  EXPECT_NEAR(settings.closure.earth_pressure.x_active, 0.61319, 5e-6);
  EXPECT_NEAR(settings.closure.earth_pressure.x_passive, 3.65818, 5e-6);
  EXPECT_TRUE(settings.closure.curvature);
  EXPECT_FALSE(solver_settings(experiment("chiou_wall", {{"continuum.curvature", "off"}})).closure.curvature);
  const SolverSettings null_zone = solver_settings(experiment("null_zone"));
  EXPECT_FALSE(null_zone.closure.curvature);
  EXPECT_TRUE(null_zone.closure.earth_pressure.is_hydraulic());
  EXPECT_EQ(null_zone.sides[3].kind, Side::Kind::periodic);
}

// A share of the greatest depth, whatever the units.
TEST(Build, DryDepthGoesWithTheFlow) {
  const Scene s = experiment("chiou_wall");
  EXPECT_DOUBLE_EQ(solver_settings(s).dry_depth, 1e-6 * deepest(s));
  const Scene fed = experiment("chiou_wall", {{"boundaries.upstream", "{inflow: {depth: 0.15 m, velocity: 1 m/s}}"}});
  EXPECT_DOUBLE_EQ(solver_settings(fed).dry_depth, 1.5e-7);
}

TEST(Build, GrainsModeNeedsNeitherCellNorRealK) {
  Scene s = experiment("chiou_wall", {{"mode", "grains"}, {"material.basal_friction_angle", "40 deg"}});
  s.continuum.cell = 0;
  const SolverSettings settings = solver_settings(s);
  EXPECT_EQ(settings.grid.nx, 239);  // 1.915 m in cells of 8 mm
  EXPECT_TRUE(settings.closure.earth_pressure.is_hydraulic());
}

TEST(Build, StepBedHoldsTheWallInWholeCells) {
  const Scene s = experiment("chiou_wall");
  const StepBed bed = step_bed(s);
  ASSERT_EQ(bed.obstacles.size(), 1u);
  const StepObstacle& wall = bed.obstacles[0];
  EXPECT_EQ(wall.name, "wall");
  EXPECT_DOUBLE_EQ(wall.x0, 0.65);
  EXPECT_DOUBLE_EQ(wall.x1, 0.66);
  EXPECT_EQ(wall.y0, -wall.y1);
  EXPECT_EQ(wall.height, 0.08);
  const CellBox cells = cells_in({wall.x0, wall.x1, wall.y0, wall.y1}, grid_of(s));
  EXPECT_EQ(cells.i0, 130);
  EXPECT_EQ(cells.i1, 132);
  EXPECT_EQ(cells.j0, 64);
  EXPECT_EQ(cells.j1, 96);
}

TEST(Build, ABoxMidwayBetweenLinesStaysSymmetric) {
  const Scene s = experiment("chiou_wall");
  const CellBox cells = cells_in({0.5025, 0.6825, -0.1025, 0.1025}, grid_of(s));  // cells of 5 mm: all edges midway
  EXPECT_EQ(cells.j0 + cells.j1, grid_of(s).ny);
  EXPECT_EQ(cells.i0, 101);
  EXPECT_EQ(cells.i1, 137);
}

TEST(Build, ReferenceSurfaceOfEachKind) {
  const double deg = std::numbers::pi / 180;
  const ReferenceSurface chute = reference_surface(experiment("chiou_wall"));
  EXPECT_NEAR(chute.angle(0.5), 40 * deg, 1e-12);
  EXPECT_NEAR(chute.angle(0.9335 + 0.1465 / 2), 20 * deg, 1e-12);
  EXPECT_NEAR(chute.angle(1.5), 0, 1e-12);
  EXPECT_NEAR(std::tan(reference_surface(experiment("null_zone")).angle(0.4)), 0.4, 1e-6);
  const Scene level = experiment("null_zone", {{"terrain", "{kind: flat, length: 0.8, width: 0.06}"}});
  EXPECT_EQ(reference_surface(level).angle(0.4), 0);
}

TEST(Build, EngineTimestep) {
  // 5e-5 s is 16 % of the Rayleigh time at d = 5 mm, E = 5 MPa, 2650 kg/m3; the smallest grain and this density scale it.
  const double expected = 5e-5 * 0.9 * std::sqrt(1425 / 0.57 / 2650);
  EXPECT_NEAR(engine_timestep(experiment("null_zone"), 1425 / 0.57) / expected, 1, 0.05);
  EXPECT_EQ(engine_timestep(experiment("null_zone", {{"grains.timestep", "0.02 ms"}}), 1425 / 0.57), 2e-5);
}

TEST(Build, MeanGrainVolume) {
  GrainSpec grains;
  grains.diameter = 0.004;
  grains.spread = 0.3;
  double sum = 0;  // midpoint sum over the radii
  const int n = 10000;
  for (int i = 0; i < n; ++i) {
    const double r = 0.002 * (1 + 0.3 * (2 * (i + 0.5) / n - 1));
    sum += 4 * std::numbers::pi / 3 * r * r * r / n;
  }
  EXPECT_NEAR(mean_grain_volume(grains) / sum, 1, 1e-6);
}

TEST(Build, ElevationOfEachShape) {
  const Scene wall =
      experiment("chiou_wall", {{"obstacles.wall.method", "elevation"}, {"obstacles.wall.size", "[40 mm, 160 mm, 80 mm]"}});
  const Grid g = grid_of(wall);
  const Elevation z = elevation(wall);
  ASSERT_EQ(z.bodies().size(), 1u);
  EXPECT_EQ(z.at(0.67, 0), 0.08);
  EXPECT_NEAR(z.slope_x(0.651, 0), 0.08 / g.dx, 1e-9);  // a ramp of one cell
  const StepBed bed = step_bed(wall);
  ASSERT_EQ(bed.elevation.size(), std::size_t(g.nx) * g.ny);
  ASSERT_EQ(bed.owner.size(), bed.elevation.size());
  EXPECT_EQ(bed.obstacles[0].height, 0);
  const std::size_t on = std::size_t(80) * g.nx + 134, beside = std::size_t(80) * g.nx + 128;
  EXPECT_EQ(bed.elevation[on], 0.08);
  EXPECT_EQ(bed.owner[on], 0);
  EXPECT_EQ(bed.elevation[beside], 0);
  EXPECT_EQ(bed.owner[beside], -1);
  // Two cells thick: the ramp is shorter than half a cell, so that the cells' centres lie on the top.
  const Scene thin = experiment("chiou_wall", {{"obstacles.wall.method", "elevation"}});
  EXPECT_NEAR(step_bed(thin).elevation[std::size_t(80) * g.nx + 130], 0.08, 1e-12);
  EXPECT_NEAR(elevation(experiment("chiou_wall", {{"obstacles.wall.method", "elevation"}, {"obstacles.wall.ramp", "4 mm"}}))
                  .slope_x(0.652, 0),
              20, 1e-9);

  const Scene wedge = experiment("chiou_wall", {{"obstacles.wall.shape", "tetrahedron"},
                                                {"obstacles.wall.method", "elevation"},
                                                {"obstacles.wall.size", "[138.564 mm, 160 mm, 80 mm]"}});
  EXPECT_NEAR(elevation(wedge).at(0.65 + 0.160 / std::sqrt(3.0), 0), 0.08, 1e-6);
  EXPECT_NEAR(elevation(wedge).slope_x(0.68, 0.001), std::sqrt(3.0) / 2, 1e-5);
}

}  // namespace
}  // namespace couloir
