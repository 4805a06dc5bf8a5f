#pragma once
// What one block adds to the sums of the whole run in one stage. Each block has its own; they are added up in block order, so
// the sums do not depend on the number of threads.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "continuum/scheme/budget.hpp"

namespace couloir {

// Of one control box, per density [m4/s].
struct BoxTerms {
  std::array<double, 2> faces{};     // momentum and pressure through the box's faces, inward positive
  double weight = 0;                 // by the weight along the slope
  std::array<double, 2> friction{};  // by friction and the cut-off of films
  void add(const BoxTerms& b) {
    weight += b.weight;
    for (int k : {0, 1}) faces[k] += b.faces[k], friction[k] += b.friction[k];
  }
};

struct Tally {
  Budget budget;
  std::vector<std::array<double, 2>> impulse;  // on each obstacle, per density [m4/s]
  std::vector<double> gauge;                   // through each gauge [m3]
  std::vector<BoxTerms> boxes;
  double min_depth = std::numeric_limits<double>::infinity();  // [m] before clipping
  bool finite = true;
  std::int64_t cell_updates = 0;

  void reset(std::size_t obstacles, std::size_t gauges, std::size_t control_boxes) {
    *this = {};
    impulse.resize(obstacles);
    gauge.resize(gauges);
    boxes.resize(control_boxes);
  }
};

}  // namespace couloir
