#include "coupling/loop/gauges.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {
namespace {

constexpr double dry = 1e-6;  // [m] thinner flow has no velocity worth showing

// Two neighbours along one direction and the weight of the second.
struct Between {
  int low, high;
  double weight;
};

Between between(double at, double origin, double size, int n) {
  const double place = std::clamp((at - origin) / size - 0.5, 0.0, double(n - 1));
  const int low = std::min(int(place), std::max(0, n - 2));
  return {low, std::min(low + 1, n - 1), place - low};
}

}  // namespace

GaugeReading read_gauge(const FlowModel& flow, const GaugeSpec& gauge) {
  const Grid& g = flow.grid();
  const Between x = between(gauge.x, g.x0, g.dx, g.nx), y = between(gauge.y, g.y0, g.dy, g.ny);
  const auto mix = [](const FlowState& a, const FlowState& b, double w) {
    return FlowState{(1 - w) * a.h + w * b.h, (1 - w) * a.hu + w * b.hu, (1 - w) * a.hv + w * b.hv};
  };
  const auto along = [&](int j) { return mix(flow.at(x.low, j), flow.at(x.high, j), x.weight); };
  const FlowState q = mix(along(y.low), along(y.high), y.weight);
  return q.h > dry ? GaugeReading{q.h, q.hu / q.h, q.hv / q.h} : GaugeReading{q.h, 0, 0};
}

}  // namespace couloir
