#include "continuum/boundary/side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace couloir {
namespace {

// Times that differ by less are the same: round-off of a clock.
double slack(double time) {
  return 1e-12 * std::max(1.0, std::abs(time));
}

}  // namespace

InflowPoint inflow_at(const Side& side, double time, Moment moment) {
  if (side.kind != Side::Kind::inflow) return {time, 0, 0};
  const std::vector<InflowPoint>& points = side.hydrograph;
  if (points.empty()) return {time, side.depth, side.velocity};
  const double at = time + (moment == Moment::before ? -slack(time) : slack(time));
  if (at < points.front().time || at > points.back().time) return {time, 0, 0};
  const auto after = std::find_if(points.begin() + 1, points.end(), [&](const InflowPoint& p) { return p.time >= at; });
  const InflowPoint& before = *(after - 1);
  const double w = std::clamp((time - before.time) / (after->time - before.time), 0.0, 1.0);
  return {time, (1 - w) * before.depth + w * after->depth, (1 - w) * before.velocity + w * after->velocity};
}

double mean_discharge(const Side& side, double from, double to) {
  const auto at = [&](double time, Moment moment) {
    const InflowPoint p = inflow_at(side, time, moment);
    return p.depth * p.velocity;
  };
  return (at(from, Moment::after) + 4 * at(0.5 * (from + to), Moment::after) + at(to, Moment::before)) / 6;
}

double next_row(const Side& side, double time) {
  double next = std::numeric_limits<double>::infinity();
  if (side.kind != Side::Kind::inflow) return next;
  for (const InflowPoint& p : side.hydrograph)
    if (p.time > time + slack(time)) next = std::min(next, p.time);
  return next;
}

double next_row(const std::array<Side, 4>& sides, double time) {
  double next = std::numeric_limits<double>::infinity();
  for (const Side& side : sides) next = std::min(next, next_row(side, time));
  return next;
}

double fastest_inflow(const Side& side, double gravity, double time) {
  const auto signal = [&](const InflowPoint& p) { return p.depth > 0 ? p.velocity + std::sqrt(gravity * p.depth) : 0.0; };
  double fastest = signal(inflow_at(side, time));
  for (const InflowPoint& p : side.hydrograph)
    if (p.time > time) fastest = std::max(fastest, signal(p));  // sqrt is concave: between two points it may be a little more
  return fastest;
}

}  // namespace couloir
