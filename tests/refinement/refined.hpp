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

// A chute that a heap slides down onto a block.
inline SolverSettings chute() {
  SolverSettings s = basin(96, 48, 0.0125);
  s.block = 8;
  s.sides = sides(Side::Kind::outflow, Side::Kind::wall);
  s.closure = quartz();
  return s;
}

inline SolverSettings adaptive(SolverSettings s, int levels) {
  s.refinement.adaptive.levels = levels;
  s.refinement.adaptive.interval = 4;
  return s;
}

inline Solver heap_on_chute(const SolverSettings& s) {
  Solver solver(s, ReferenceSurface::chute(degrees(38), 0.7, 0.2, 0.3), {{}, {{"block", 0.6, 0.66, -0.08, 0.1, 0.05}}});
  solver.set([](double x, double y) {
    const double r2 = ((x - 0.2) * (x - 0.2) + y * y) / 0.0225;
    return FlowState{r2 < 1 ? 0.08 * (1 - r2) : 0.0, 0, 0};
  });
  return solver;
}

inline double mean_difference(const Solver& a, const Solver& b) {
  double sum = 0;
  for (int j = 0; j < a.grid().ny; ++j) {
    for (int i = 0; i < a.grid().nx; ++i) sum += std::abs(a.at(i, j).h - b.at(i, j).h);
  }
  return sum / (a.grid().nx * a.grid().ny);
}

}  // namespace couloir::test
