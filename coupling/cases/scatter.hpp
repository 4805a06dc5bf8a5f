#pragma once
#include <span>

namespace couloir {

// Of the values that are numbers; NaN where they are too few (scatter: fewer than two).
struct Scatter {
  int count = 0;
  double mean, scatter;  // standard deviation of a sample (n - 1)
  double least, largest;
};

Scatter scatter_of(std::span<const double> values);

}  // namespace couloir
