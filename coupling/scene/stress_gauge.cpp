#include "coupling/scene/stress_gauge.hpp"

#include <cmath>
#include <numbers>

namespace couloir {
namespace {

const double flat_share = std::tan(std::numbers::pi / gauge_sides);  // of the radius: half of a side

}  // namespace

GaugeBox gauge_box(const StressGaugeSpec& g) {
  const double x = g.radius > 0 ? g.radius : g.width / 2, y = g.radius > 0 ? g.radius : g.height / 2;
  return {g.across - x, g.across + x, g.up - y, g.up + y};
}

double gauge_area(const StressGaugeSpec& g) {
  return g.radius > 0 ? gauge_sides * gauge_flat(g) * g.radius : g.width * g.height;
}

double gauge_flat(const StressGaugeSpec& g) {
  return flat_share * g.radius;
}

std::string gauge_key(const Scene& scene, const StressGaugeSpec& g) {
  return "obstacles." + scene.obstacles[static_cast<std::size_t>(g.obstacle)].name + ".gauges." + g.name;
}

}  // namespace couloir
