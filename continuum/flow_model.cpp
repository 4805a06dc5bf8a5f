#include "continuum/flow_model.hpp"

#include <algorithm>

namespace couloir {

void FlowModel::advance_to(double t_end) {
  while (time() < t_end) {
    const double left = t_end - time(), dt = stable_dt();
    if (left <= dt) {
      step(left);
      // A step that would have overdrawn a cell was taken at half its length: then this is not the end yet.
      if (t_end - time() < 0.25 * left) set_time(t_end);
    } else {
      step(std::min(dt, 0.5 * left));  // no splinter of a last step
    }
  }
}

}  // namespace couloir
