#include "coupling/loop/gauges.hpp"

namespace couloir {
namespace {

GaugeReading reading(const FlowState& q, double thin) {
  return q.h > thin ? GaugeReading{q.h, q.hu / q.h, q.hv / q.h} : GaugeReading{q.h, 0, 0};
}

// The deepest of the finest cells whose centres lie in the rectangle; where none does, the one nearest to its middle.
FlowState deepest(const FlowModel& flow, const GaugeSpec& gauge) {
  FlowState most;
  bool any = false;
  const double half = 0.5 * gauge.width;
  flow.for_finest(gauge.x, gauge.x + gauge.length, gauge.y - half, gauge.y + half, [&](const FlowModel::Sample& s) {
    if (!any || s.q.h > most.h) most = s.q;
    any = true;
  });
  return most;
}

}  // namespace

GaugeReading read_gauge(const FlowModel& flow, const GaugeSpec& gauge, double thin) {
  const bool point = gauge.length == 0 && gauge.width == 0;
  return reading(point ? flow.interpolated(gauge.x, gauge.y) : deepest(flow, gauge), thin);
}

}  // namespace couloir
