#include "coupling/plan/mass_point.hpp"

#include <cmath>

namespace couloir {

// Each step takes the inclination at its middle: exact where it is the same all along.
std::vector<MassPoint> slide(const ReferenceSurface& surface, double gravity, double mu, const MassPoint& start, double end,
                             int steps) {
  std::vector<MassPoint> line{start};
  const double step = (end - start.x) / steps;
  for (int n = 1; n <= steps; ++n) {
    const MassPoint& here = line.back();
    const double u = here.velocity, zeta = surface.angle(here.x + step / 2);
    const double acceleration = gravity * (std::sin(zeta) - mu * std::cos(zeta));
    const double squared = u * u + 2 * acceleration * step;
    if (squared <= 0) {
      if (u > 0) line.push_back({here.x - u * u / (2 * acceleration), here.time - u / acceleration, 0});
      break;
    }
    const double next = std::sqrt(squared);
    if (u + next <= 1e-9) break;
    line.push_back({start.x + n * step, here.time + 2 * step / (u + next), next});
  }
  return line;
}

double energy_head(const MassPoint& point, double gravity) {
  return point.velocity * point.velocity / (2 * gravity);
}

}  // namespace couloir
