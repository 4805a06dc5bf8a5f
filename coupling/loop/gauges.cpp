#include "coupling/loop/gauges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace couloir {
namespace {

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

GaugeReading reading(const FlowState& q, double thin) {
  return q.h > thin ? GaugeReading{q.h, q.hu / q.h, q.hv / q.h} : GaugeReading{q.h, 0, 0};
}

// The deepest cell whose centre lies in the rectangle; where none does, the one nearest to its middle.
FlowState deepest(const FlowModel& flow, const GaugeSpec& gauge) {
  const Grid& g = flow.grid();
  const double slack = 1e-9 * (g.dx + g.dy);
  const auto first = [&](double at, double origin, double size) { return int(std::ceil((at - slack - origin) / size - 0.5)); };
  const auto last = [&](double at, double origin, double size) { return int(std::floor((at + slack - origin) / size - 0.5)); };
  const auto range = [&](double low, double high, double origin, double size, int n) {
    int a = first(low, origin, size), b = last(high, origin, size);
    if (a > b) a = b = int(std::floor((0.5 * (low + high) - origin) / size));
    return std::pair{std::clamp(a, 0, n - 1), std::clamp(b, 0, n - 1)};
  };
  const auto [i0, i1] = range(gauge.x, gauge.x + gauge.length, g.x0, g.dx, g.nx);
  const auto [j0, j1] = range(gauge.y - 0.5 * gauge.width, gauge.y + 0.5 * gauge.width, g.y0, g.dy, g.ny);
  FlowState most = flow.at(i0, j0);
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      if (flow.at(i, j).h > most.h) most = flow.at(i, j);
    }
  }
  return most;
}

}  // namespace

GaugeReading read_gauge(const FlowModel& flow, const GaugeSpec& gauge, double thin) {
  if (gauge.length > 0 || gauge.width > 0) return reading(deepest(flow, gauge), thin);
  const Grid& g = flow.grid();
  const Between x = between(gauge.x, g.x0, g.dx, g.nx), y = between(gauge.y, g.y0, g.dy, g.ny);
  const auto mix = [](const FlowState& a, const FlowState& b, double w) {
    return FlowState{(1 - w) * a.h + w * b.h, (1 - w) * a.hu + w * b.hu, (1 - w) * a.hv + w * b.hv};
  };
  const auto along = [&](int j) { return mix(flow.at(x.low, j), flow.at(x.high, j), x.weight); };
  return reading(mix(along(y.low), along(y.high), y.weight), thin);
}

}  // namespace couloir
