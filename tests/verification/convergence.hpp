#pragma once
// Errors against exact solutions and the order at which they fall.

#include <cmath>

#include "continuum/solver.hpp"
#include "tests/continuum/scenes.hpp"

namespace couloir::test {

// L1 error of the depth in row 0 [m2]; exact: depth at x.
template <class F>
double depth_error(const FlowModel& s, F&& exact) {
  double sum = 0;
  for (int i = 0; i < s.grid().nx; ++i) sum += std::abs(s.at(i, 0).h - exact(s.grid().x(i)));
  return sum * s.grid().dx;
}

// Order between an error at n cells and one at factor * n.
inline double order(double coarse, double fine, double factor = 2) {
  return std::log(coarse / fine) / std::log(factor);
}

// One row of cells from x0, frictionless, hydraulic.
inline SolverSettings row(int nx, double x0, double length, Side::Kind ends) {
  SolverSettings s;
  s.grid = {nx, 1, length / nx, length / nx, x0, 0};
  s.sides = sides(ends, Side::Kind::wall);
  return s;
}

}  // namespace couloir::test
