#include "coupling/loop/observer.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

double MassLedger::relative_error() const {
  const double scale = std::max(initial, entered);
  return scale > 0 ? std::abs(total() - initial) / scale : 0;
}

}  // namespace couloir
