#include "continuum/flow_model.hpp"

#include <algorithm>
#include <string>

#include "continuum/errors.hpp"

namespace couloir {

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
      if (t_end - time() < 1e-9 * left) set_time(t_end);  // it may have been cut shorter
    } else {
      step(std::min(dt, 0.5 * left));  // no splinter of a last step
    }
  }
}

}  // namespace couloir
