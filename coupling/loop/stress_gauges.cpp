#include "coupling/loop/stress_gauges.hpp"

#include "coupling/scene/stress_gauge.hpp"

namespace couloir {

std::vector<StressGauge> stress_gauges(const Scene& scene, const std::vector<PlannedZone>& zones) {
  std::vector<StressGauge> read;
  if (scene.mode == Mode::continuum) return read;
  for (const StressGaugeSpec& g : scene.stress_gauges) {
    const ObstacleSpec& o = scene.obstacles[std::size_t(g.obstacle)];
    if (scene.mode == Mode::grains || any_holds(zones, o)) read.push_back({g.obstacle, o.name, g.name, gauge_area(g)});
  }
  return read;
}

std::string surface_of(const StressGauge& g) {
  return g.of + "." + g.name;  // no name holds a dot
}

}  // namespace couloir
