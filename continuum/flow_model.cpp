#include "continuum/flow_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "continuum/errors.hpp"

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

}  // namespace

void FlowModel::for_finest(double x0, double x1, double y0, double y1, const std::function<void(const Sample&)>& f) const {
  const Grid& g = grid();
  const CellBox box = centres_in(g, x0, x1, y0, y1);
  const auto nearest = [](int i, int n) { return std::clamp(i, 0, n - 1); };
  for (int j = nearest(box.j0, g.ny); j <= nearest(box.j1 - 1, g.ny); ++j) {
    for (int i = nearest(box.i0, g.nx); i <= nearest(box.i1 - 1, g.nx); ++i) f({g.x(i), g.y(j), at(i, j)});
  }
}

FlowState FlowModel::interpolated(double px, double py) const {
  const Grid& g = grid();
  const Between x = between(px, g.x0, g.dx, g.nx), y = between(py, g.y0, g.dy, g.ny);
  const auto mix = [](const FlowState& a, const FlowState& b, double w) {
    return FlowState{(1 - w) * a.h + w * b.h, (1 - w) * a.hu + w * b.hu, (1 - w) * a.hv + w * b.hv};
  };
  const auto along = [&](int j) { return mix(at(x.low, j), at(x.high, j), x.weight); };
  return mix(along(y.low), along(y.high), y.weight);
}

void FlowModel::fail_step(double dt) const {
  throw NumericsError("The flow has become so fast (" + std::to_string(max_speed()) + " m/s) that stable steps of " +
                      std::to_string(dt * 1e9) + " ns no longer get anywhere at t = " + std::to_string(time()) +
                      " s; check what was released or comes in, or use larger cells.");
}

void FlowModel::advance_to(double t_end) {
  constexpr double least_step = 1e-10;  // of the span: beyond 1e10 steps the run would not end
  const double span = t_end - time();
  while (time() < t_end) {
    const double left = t_end - time(), dt = stable_dt();
    if (dt < least_step * span) fail_step(dt);
    if (left <= dt) {
      step(left);
      // It may have been cut shorter, and the next one again, down to what the clock no longer resolves.
      if (t_end - time() < 1e-9 * span) set_time(t_end);
    } else {
      step(std::min(dt, 0.5 * left));  // no splinter of a last step
    }
  }
}

}  // namespace couloir
