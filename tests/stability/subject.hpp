#pragma once
// The solvers under test. Every case asks its subject for a solver, so that another scheme goes through the same cases by one
// more entry in subjects().

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "continuum/solver.hpp"
#include "continuum/terrain/elevation.hpp"

namespace couloir::test {

struct Subject {
  std::string name;
  bool has_steps;  // false: obstacles are elevations of the bed, as body_of() makes them
  double energy;   // share of the start's energy that the scheme itself may add
  std::function<std::unique_ptr<FlowModel>(const SolverSettings&, const ReferenceSurface&, const StepBed&)> make;
};

std::vector<Subject> subjects();

// The obstacle as a scene makes it of method elevation: a ramp of a cell, or of a quarter of the shorter side.
ElevationBody body_of(const StepObstacle&, const Grid&);

inline std::ostream& operator<<(std::ostream& out, const Subject& s) {
  return out << s.name;
}

}  // namespace couloir::test
