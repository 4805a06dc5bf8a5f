#include "coupling/cases/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace couloir {

Scatter scatter_of(std::span<const double> values) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Scatter s{0, nan, nan, nan, nan};
  double sum = 0, squares = 0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    ++s.count;
    sum += v;
    s.least = std::fmin(s.least, v);
    s.largest = std::fmax(s.largest, v);
  }
  if (s.count == 0) return s;
  s.mean = sum / s.count;
  for (const double v : values)
    if (!std::isnan(v)) squares += (v - s.mean) * (v - s.mean);
  if (s.count > 1) s.scatter = std::sqrt(squares / (s.count - 1));
  return s;
}

}  // namespace couloir
