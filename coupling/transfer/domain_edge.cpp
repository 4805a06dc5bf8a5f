#include "coupling/transfer/domain_edge.hpp"

namespace couloir {

void DomainEdge::take(const Grains& g, const ReferenceSurface& surface, std::vector<std::int64_t>& remove,
                      const std::function<bool(std::int64_t)>& counted) {
  for (std::size_t i = 0; i < g.size(); ++i) {
    const SurfacePoint p = surface.to_surface({g.x[i], g.y[i], g.z[i]});
    const bool out =
        (open_[0] && p.x < 0) || (open_[1] && p.x > length_) || (open_[2] && p.y < -width_ / 2) || (open_[3] && p.y > width_ / 2);
    if (!out) continue;
    remove.push_back(g.id[i]);
    if (!counted(g.id[i])) continue;
    const double m = grain_mass(g.radius[i], density_);
    mass_ += m;
    momentum_ += m * along_.dot(Eigen::Vector3d(g.vx[i], g.vy[i], g.vz[i]));
  }
}

}  // namespace couloir
