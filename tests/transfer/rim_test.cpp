#include "coupling/transfer/rim.hpp"

#include <gtest/gtest.h>

#include "coupling/engine/drive_face.hpp"

namespace couloir {
namespace {

const Grid grid{100, 40, 0.01, 0.01, 0, -0.2};
const RimSettings settings{.diameter = 0.004};

TEST(Rim, HasFacesOnlyWhereTheZoneEndsInsideTheDomain) {
  const auto surface = ReferenceSurface::incline(0.6, 1.0);
  EXPECT_EQ(Rim(grid, {30, 60, 10, 30}, surface, settings).faces().size(), 4u);
  EXPECT_EQ(Rim(grid, {30, 60, 0, 40}, surface, settings).faces().size(), 2u);
  EXPECT_EQ(Rim(grid, {30, 100, 0, 40}, surface, settings).faces().size(), 1u);
}

TEST(Rim, FacesKnowTheWallsOfTheDomainAtTheirEnds) {
  RimSettings walled = settings;
  walled.walls = {false, true, true, false};
  using Walls = std::array<bool, 2>;
  const auto walls = [&](const CellBox& box) {
    std::vector<Walls> all;
    const auto surface = ReferenceSurface::flat(1.0);
    const Rim rim(grid, box, surface, walled);
    for (const RimFace& face : rim.faces()) all.push_back(face.walls);
    return all;
  };
  EXPECT_EQ(walls({30, 60, 10, 30}), std::vector<Walls>(4, Walls{false, false}));
  EXPECT_EQ(walls({30, 60, 0, 40}), (std::vector<Walls>{{true, false}, {true, false}})) << "the right side is open";
  EXPECT_EQ(walls({30, 100, 10, 30}), (std::vector<Walls>{{false, false}, {false, true}, {false, true}}));
}

TEST(Rim, DistanceIsPositiveInsideAndCellsAreCountedFromTheLowEnd) {
  const auto surface = ReferenceSurface::incline(0.6, 1.0);
  const Rim rim(grid, {30, 60, 10, 30}, surface, settings);
  for (const RimFace& face : rim.faces()) {
    const Eigen::Vector3d centre = surface.to_space({0.45, 0, 0.01});
    EXPECT_GT(face.distance({centre.x(), centre.y(), centre.z()}), 0);
    EXPECT_EQ(face.cell_at(0.5 * face.cell_width), 0);
    EXPECT_EQ(face.cell_at(1e9), face.cells - 1);
    const auto [i, j] = rim.outside_cell(face, 3);
    const auto [ci, cj] = rim.inside_cell(face, 3);
    EXPECT_EQ(std::abs(i - ci) + std::abs(j - cj), 1);
    const Eigen::Vector3d out = surface.to_space({grid.x(i), grid.y(j), 0.01}),
                          in = surface.to_space({grid.x(ci), grid.y(cj), 0.01});
    EXPECT_NEAR(face.distance({out.x(), out.y(), out.z()}), -0.005, 1e-12);
    EXPECT_NEAR(face.distance({in.x(), in.y(), in.z()}), 0.005, 1e-12);
    EXPECT_EQ(face.cell_at(face.along({in.x(), in.y(), in.z()})), 3);
  }
}

// Across incline, arc and run-out: a grain belongs to the cell that it is over, whatever its height.
TEST(Rim, LateralFacesFollowTheArc) {
  const auto surface = ReferenceSurface::chute(0.8, 0.3, 0.4, 0.3);
  const Rim rim(grid, {20, 90, 10, 30}, surface, settings);
  int lateral = 0;
  for (const RimFace& face : rim.faces()) {
    if (face.axis() == 0) continue;
    ++lateral;
    for (int k = 0; k < face.cells; ++k) {
      const auto [i, j] = rim.outside_cell(face, k);
      for (double n : {0.0, 0.04}) {
        const Eigen::Vector3d p = surface.to_space({grid.x(i), grid.y(j), n});
        EXPECT_EQ(face.cell_at(face.along({p.x(), p.y(), p.z()})), k) << n;
        EXPECT_NEAR(face.distance({p.x(), p.y(), p.z()}), -0.005, 1e-12);
      }
    }
  }
  EXPECT_EQ(lateral, 2);
}

TEST(Rim, APlaceIsWhereItsDistanceAndItsCellSay) {
  const auto surface = ReferenceSurface::chute(0.8, 0.3, 0.4, 0.3);
  for (const CellBox& zone : {CellBox{20, 90, 10, 30}, CellBox{45, 60, 10, 30}}) {
    const Rim rim(grid, zone, surface, settings);
    for (const RimFace& face : rim.faces()) {
      for (double along : {0.003, 0.061}) {
        const Vec p = face.place(-0.004, along, 0.02);
        const SurfacePoint s = surface.to_surface({p[0], p[1], p[2]});
        EXPECT_NEAR(s.n, 0.02, 1e-12);
        EXPECT_NEAR(face.along(p), along, 1e-12);
        EXPECT_NEAR(face.distance(p), -0.004, 2e-4);  // by arc, not by tangent: 0.004 * 0.02 / R
      }
    }
  }
}

// What the engine knows of a face is what the exchange knows.
TEST(Rim, TheEngineFindsPlaceAndDirectionAlongAFaceBesideAnArc) {
  const auto surface = ReferenceSurface::chute(0.8, 0.3, 0.4, 0.3);
  const double radius = 0.4 / 0.8;
  // Over both ends of the arc, from within it, on the incline, on the run-out.
  for (const CellBox& zone :
       {CellBox{20, 90, 10, 30}, CellBox{45, 80, 10, 30}, CellBox{5, 25, 10, 30}, CellBox{75, 95, 10, 30}}) {
    const Rim rim(grid, zone, surface, settings);
    for (const RimFace& face : rim.faces())
      for (double along = 0.005; along < face.extent(); along += 0.01)
        for (double height : {0.0, 0.03}) {
          const PlaceOnFace at = place_on(face.drive, face.place(-0.004, along, height));
          const double x = face.x0 + (face.axis() == 0 ? -0.004 * face.sign() : along);
          const bool on_arc = x > 0.3 && x < 0.7;
          const Vec direction = face.direction(along);
          EXPECT_NEAR(at.along, along, 1e-12);
          for (int k = 0; k < 3; ++k) EXPECT_NEAR(at.direction[k], direction[k], 1e-12);
          EXPECT_NEAR(at.pace, face.axis() == 1 && on_arc ? 1 - height / radius : 1, 1e-12);
        }
  }
}

TEST(Rim, AFaceSlidesBetweenEndsThatLetTheFlowPass) {
  RimSettings s = settings;
  s.open = {true, false, false, true};  // the others are walls, or periodic
  const auto surface = ReferenceSurface::chute(0.8, 0.3, 0.4, 0.3);
  const auto slides = [&](const CellBox& box) {
    std::vector<bool> all;
    const Rim rim(grid, box, surface, s);
    for (const RimFace& face : rim.faces()) all.push_back(face.slides);
    return all;
  };
  EXPECT_EQ(slides({20, 90, 10, 30}), (std::vector<bool>{true, true, true, true}));
  EXPECT_EQ(slides({0, 60, 10, 30}), (std::vector<bool>{true, true, true})) << "flow comes in upstream";
  EXPECT_EQ(slides({20, 100, 10, 30}), (std::vector<bool>{true, false, false})) << "a wall stands downstream";
  EXPECT_EQ(slides({20, 60, 10, 40}), (std::vector<bool>{true, true, true})) << "it goes out at the right";
  EXPECT_EQ(slides({20, 60, 0, 40}), (std::vector<bool>{false, false})) << "a wall stands at the left";
}

TEST(Rim, SegmentsAreAtLeastAsWideAsAskedAndCoverTheFace) {
  const auto surface = ReferenceSurface::flat(1.0);
  const Rim rim(grid, {30, 60, 10, 30}, surface, settings);
  const RimFace& face = rim.faces()[0];
  EXPECT_GE(face.drive.segment_width, settings.segment * settings.diameter);
  EXPECT_EQ(face.segment_of_cell(face.cells - 1), face.segments - 1);
}

}  // namespace
}  // namespace couloir
