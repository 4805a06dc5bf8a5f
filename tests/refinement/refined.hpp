#pragma once
// Small runs over two and three sizes of cells.

#include <cmath>

#include "../continuum/scenes.hpp"

namespace couloir::test {

// Cells of a basin halved so many times in a rectangle.
inline SolverSettings refined(SolverSettings s, const RefineBox& box) {
  s.refinement.boxes.push_back(box);
  return s;
}

inline double mean_difference(const Solver& a, const Solver& b) {
  double sum = 0;
  for (int j = 0; j < a.grid().ny; ++j) {
    for (int i = 0; i < a.grid().nx; ++i) sum += std::abs(a.at(i, j).h - b.at(i, j).h);
  }
  return sum / (a.grid().nx * a.grid().ny);
}

}  // namespace couloir::test
