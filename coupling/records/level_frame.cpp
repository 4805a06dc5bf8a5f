#include "coupling/records/level_frame.hpp"

namespace couloir {
namespace {

void add(std::vector<float>& out, const Eigen::Vector3d& v) {
  for (int c = 0; c < 3; ++c) out.push_back(float(v[c]));
}

// to_level is a rotation and perhaps a shift; a velocity is only rotated.
Eigen::Vector3d turn(const ReferenceSurface& surface, const Eigen::Vector3d& v) {
  return surface.to_level(v) - surface.to_level(Eigen::Vector3d::Zero());
}

}  // namespace

std::vector<float> level_nodes(const Grid& grid, const ReferenceSurface& surface) {
  std::vector<float> out;
  for (int j = 0; j <= grid.ny; ++j)
    for (int i = 0; i <= grid.nx; ++i)
      add(out, surface.to_level(surface.to_space({grid.x0 + i * grid.dx, grid.y0 + j * grid.dy, 0})));
  return out;
}

std::vector<float> level_free_surface(const Grid& grid, const ReferenceSurface& surface, const std::vector<double>& bed,
                                      const std::vector<double>& h) {
  // Across and along the normal a column of cells is straight: one frame for all of it.
  std::vector<float> out(3 * h.size());
  const Eigen::Vector3d across = turn(surface, Eigen::Vector3d::UnitY());
  for (int i = 0; i < grid.nx; ++i) {
    const double x = grid.x(i);
    const Eigen::Vector3d foot = surface.to_level(surface.to_space({x, 0, 0})), up = turn(surface, surface.normal(x));
    for (int j = 0; j < grid.ny; ++j) {
      const auto k = std::size_t(j) * grid.nx + i;
      const Eigen::Vector3d v = foot + grid.y(j) * across + ((bed.empty() ? 0 : bed[k]) + h[k]) * up;
      for (int c = 0; c < 3; ++c) out[3 * k + c] = float(v[c]);
    }
  }
  return out;
}

std::vector<float> level_velocity(const Grid& grid, const ReferenceSurface& surface, const std::vector<double>& h,
                                  const std::vector<double>& hu, const std::vector<double>& hv, double thin) {
  std::vector<float> out(3 * h.size(), 0.0f);
  for (int i = 0; i < grid.nx; ++i) {
    const Eigen::Vector3d along = turn(surface, surface.tangent(grid.x(i))), across = turn(surface, Eigen::Vector3d::UnitY());
    for (int j = 0; j < grid.ny; ++j) {
      const auto k = std::size_t(j) * grid.nx + i;
      if (h[k] <= thin) continue;
      const Eigen::Vector3d v = (hu[k] * along + hv[k] * across) / h[k];
      for (int c = 0; c < 3; ++c) out[3 * k + c] = float(v[c]);
    }
  }
  return out;
}

std::vector<float> level_positions(const ReferenceSurface& surface, const Grains& grains) {
  std::vector<float> out;
  for (std::size_t k = 0; k < grains.size(); ++k) add(out, surface.to_level({grains.x[k], grains.y[k], grains.z[k]}));
  return out;
}

std::vector<float> level_velocities(const ReferenceSurface& surface, const Grains& grains) {
  std::vector<float> out;
  for (std::size_t k = 0; k < grains.size(); ++k) add(out, turn(surface, {grains.vx[k], grains.vy[k], grains.vz[k]}));
  return out;
}

}  // namespace couloir
