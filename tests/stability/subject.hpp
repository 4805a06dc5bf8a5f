#pragma once
// The solver under test. Every case asks its subject for a solver, so that another scheme goes through the same cases by one
// more entry in subjects().

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "continuum/solver.hpp"

namespace couloir::test {

struct Subject {
  std::string name;
  std::function<std::unique_ptr<FlowModel>(const SolverSettings&, const ReferenceSurface&, const StepBed&)> make;
};

inline std::vector<Subject> subjects() {
  return {{"central_upwind", [](const SolverSettings& s, const ReferenceSurface& surface, const StepBed& bed) {
             return std::make_unique<Solver>(s, surface, bed);
           }}};
}

inline std::ostream& operator<<(std::ostream& out, const Subject& s) {
  return out << s.name;
}

}  // namespace couloir::test
