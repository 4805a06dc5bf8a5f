#include "coupling/transfer/coarse_grain.hpp"

#include <cmath>

namespace couloir {

CoarseGrained coarse_grain(const Grains& g, const Grid& grid, const CellBox& box, const ReferenceSurface& surface,
                           double grain_density, double bulk_density, bool periodic_y) {
  const int nx = box.i1 - box.i0, ny = box.j1 - box.j0;
  CoarseGrained out{box, std::vector<FlowState>(std::size_t(nx) * ny)};
  const double per_cell = 1 / (bulk_density * grid.dx * grid.dy);
  for (std::size_t n = 0; n < g.size(); ++n) {
    const SurfacePoint p = surface.to_surface({g.x[n], g.y[n], g.z[n]});
    const double fx = (p.x - grid.x0) / grid.dx - 0.5 - box.i0, fy = (p.y - grid.y0) / grid.dy - 0.5 - box.j0;
    const int i = int(std::floor(fx)), j = int(std::floor(fy));
    if (i < -1 || i >= nx) continue;
    if (!periodic_y && (j < -1 || j >= ny)) continue;
    const Eigen::Vector3d t = surface.tangent(p.x);
    const double depth = grain_mass(g.radius[n], grain_density) * per_cell;
    const double u = g.vx[n] * t.x() + g.vz[n] * t.z();
    for (int b = 0; b < 2; ++b)
      for (int a = 0; a < 2; ++a) {
        const int ci = i + a;
        int cj = j + b;
        if (periodic_y) cj = ((cj % ny) + ny) % ny;
        if (ci < 0 || ci >= nx || cj < 0 || cj >= ny) continue;
        const double w = (a ? fx - i : 1 - (fx - i)) * (b ? fy - j : 1 - (fy - j));
        FlowState& cell = out.cells[std::size_t(cj) * nx + ci];
        cell.h += w * depth;
        cell.hu += w * depth * u;
        cell.hv += w * depth * g.vy[n];
      }
  }
  return out;
}

}  // namespace couloir
