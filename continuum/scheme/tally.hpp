#pragma once
// What one block adds to the sums of the whole run in one stage. Each block has its own; they are added up in block order, so
// the sums do not depend on the number of threads.

#include <array>
#include <limits>
#include <vector>

#include "continuum/scheme/budget.hpp"

namespace couloir {

struct Tally {
  Budget budget;
  std::vector<std::array<double, 2>> impulse;                  // on each obstacle, per density [m4/s]
  std::vector<double> gauge;                                   // through each gauge [m3]
  double min_depth = std::numeric_limits<double>::infinity();  // [m] before clipping
  bool finite = true;

  void reset(std::size_t obstacles, std::size_t gauges) {
    *this = {};
    impulse.resize(obstacles);
    gauge.resize(gauges);
  }
};

}  // namespace couloir
