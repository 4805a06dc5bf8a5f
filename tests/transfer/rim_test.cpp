#include "coupling/transfer/rim.hpp"

#include <gtest/gtest.h>

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

TEST(Rim, SegmentsAreAtLeastAsWideAsAskedAndCoverTheFace) {
  const Rim rim(grid, {30, 60, 10, 30}, ReferenceSurface::flat(1.0), settings);
  const RimFace& face = rim.faces()[0];
  EXPECT_GE(face.drive.segment_width, settings.segment * settings.diameter);
  EXPECT_EQ(face.segment_of_cell(face.cells - 1), face.segments - 1);
}

}  // namespace
}  // namespace couloir
