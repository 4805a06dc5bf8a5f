#pragma once
// A scene of the solver as plain data, so that it can be mirrored and scaled.

#include <string>
#include <vector>

#include "subject.hpp"

namespace couloir::test {

struct Case {
  SolverSettings settings;
  double angle = 0, slope = 0, arc = 0, runout = 0;  // of ReferenceSurface::chute [rad], [m]
  StepBed bed;
  std::vector<FlowState> start;  // [j * nx + i]

  const Grid& grid() const { return settings.grid; }
  ReferenceSurface surface() const;
  bool has(Side::Kind) const;  // on some side
  // Sets the start from the state at each cell's centre.
  template <class F>
  void fill(F&& state) {
    start.clear();
    for (int j = 0; j < grid().ny; ++j) {
      for (int i = 0; i < grid().nx; ++i) start.push_back(state(grid().x(i), grid().y(j)));
    }
  }
  std::unique_ptr<FlowModel> build(const Subject&) const;
};

// A frictionless K = 1 channel or basin on a plane: walls all round, y from -width/2, dry.
Case plane(double angle, int nx, int ny, double dx, double dy);

// The case with y turned round.
Case mirrored(const Case&);

// All lengths times the factor; times and velocities then go with its root. For a factor 4^n every dimensionless number keeps
// its bits.
Case scaled(const Case&, double factor);

}  // namespace couloir::test
