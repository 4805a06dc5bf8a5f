#include "coupling/transfer/overtopping.hpp"

namespace couloir {

void Overtopping::look(const Grains& g, const ReferenceSurface& surface) {
  for (std::size_t i = 0; i < g.size(); ++i) {
    const SurfacePoint p = surface.to_surface({g.x[i], g.y[i], g.z[i]});
    if (g.id[i] >= std::int64_t(side_.size())) side_.resize(2 * g.id[i] + 1000, 0);
    const signed char now = p.x < middle_ ? -1 : 1;
    signed char& before = side_[g.id[i]];
    if (before != 0 && before != now && p.y > y0_ && p.y < y1_) mass_ += now * grain_mass(g.radius[i], density_);
    before = now;
  }
}

}  // namespace couloir
