#include "coupling/calibration/bracket.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

BracketResult search_bracket(const Bracket& b, double target, const std::function<double(double)>& quantity) {
  BracketResult out;
  const auto miss = [&](double parameter) {
    const BracketTry one{parameter, quantity(parameter)};
    if (out.tries.empty() || std::abs(one.quantity - target) < std::abs(out.best.quantity - target)) out.best = one;
    out.tries.push_back(one);
    return one.quantity - target;
  };
  const auto near = [&](double m) { return std::abs(m) <= b.tolerance; };

  double low = b.low, high = b.high, width = high - low;
  double at_low = miss(low), at_high = at_low;
  if (at_low > 0) {
    while (at_low > 0 && !near(at_low) && low > b.least) {
      high = low;
      at_high = at_low;
      low = std::max(b.least, low - width);
      width *= 2;
      at_low = miss(low);
    }
  } else if (!near(at_low)) {
    at_high = miss(high);
    while (at_high < 0 && !near(at_high) && high < b.most) {
      low = high;
      at_low = at_high;
      high = std::min(b.most, high + width);
      width *= 2;
      at_high = miss(high);
    }
  }
  out.low = low;
  out.high = high;
  const double found = out.best.quantity - target;
  out.bracketed = near(found) || (at_low <= 0 && at_high >= 0);
  if (near(found) || !out.bracketed) return out;

  double weight_low = at_low, weight_high = at_high;
  for (int k = 0, side = 0; k < b.most_tries && high - low > b.narrow; ++k) {
    const double share = std::clamp(weight_low / (weight_low - weight_high), 0.05, 0.95);
    const double middle = low + share * (high - low), m = miss(middle);
    if (m < 0) {
      low = middle;
      weight_low = m;
      if (side == -1) weight_high /= 2;
      side = -1;
    } else {
      high = middle;
      weight_high = m;
      if (side == 1) weight_low /= 2;
      side = 1;
    }
    out.low = low;
    out.high = high;
    if (near(m)) break;
  }
  return out;
}

}  // namespace couloir
