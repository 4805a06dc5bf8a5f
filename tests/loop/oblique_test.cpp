// A uniform flow crosses a zone of grains: head on, obliquely through two of its faces, and grazing two of them. Nothing changes
// it, so that the zone keeps its depth and what stands beside it, too.
#include <gmock/gmock.h>

#include <cmath>

#include "small_run.hpp"

namespace couloir {
namespace {

struct Depths {
  double zone, beside;  // [m] of the zone's cells, of those within 40 mm of its sides
};

Depths depths_at_end(const Watched& run, const Grid& grid, const CellBox& zone) {
  const auto& h = run.frames.back();
  const int band = int(std::round(0.04 / grid.dy));
  double sum[2] = {};
  int cells[2] = {};
  for (int j = zone.j0 - band; j < zone.j1 + band; ++j)
    for (int i = zone.i0; i < zone.i1; ++i) {
      const int outside = j < zone.j0 || j >= zone.j1;
      sum[outside] += h[std::size_t(j) * grid.nx + i];
      ++cells[outside];
    }
  return {sum[0] / cells[0], sum[1] / cells[1]};
}

class AcrossAZone : public testing::TestWithParam<double> {};

TEST_P(AcrossAZone, AUniformFlowStaysAsItIs) {
  const double across = GetParam();
  const std::string folder = fresh_folder("oblique_" + std::to_string(int(100 * across)));
  const Scene scene = read_scene(COULOIR_SOURCE_DIR "/tests/scenes/oblique.yaml", COULOIR_SOURCE_DIR "/dem_inputs/materials",
                                 {{"release.velocity_across", std::to_string(across) + " m/s"},
                                  {"grains.diameter", "8 mm"},
                                  {"record.frames", "180 ms"},
                                  {"duration", "180 ms"}});
  const Watched run = watch(scene, options_in(folder));
  for (const WindowReport& w : run.windows) {
    EXPECT_LT(w.mass.relative_error(), 1e-12) << w.time;
    EXPECT_LT(w.max_overlap, 0.1) << w.time << ": a layer lets go of grains that overlap";
  }
  const Grid grid{140, 160, 0.01, 0.01, 0, -0.8};
  const Depths at_end = depths_at_end(run, grid, {70, 90, 70, 90});
  EXPECT_NEAR(at_end.zone, 0.03, 0.05 * 0.03) << "kept out by its sides, or spread through them";
  EXPECT_NEAR(at_end.beside, 0.03, 0.05 * 0.03) << "dammed up beside it";
}

INSTANTIATE_TEST_SUITE_P(At, AcrossAZone, testing::Values(0.0, 0.25, 0.6, -0.45), [](const auto& info) {
  return (info.param < 0 ? "minus" : "") + std::to_string(int(std::round(std::abs(100 * info.param)))) + "cm_s";
});

}  // namespace
}  // namespace couloir
