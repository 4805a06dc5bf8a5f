#pragma once
// The hard cases run once for each solver under test.

#include <gtest/gtest.h>

#include <cmath>

#include "demands.hpp"
#include "tests/continuum/scenes.hpp"

namespace couloir::test {

class Stability : public testing::TestWithParam<Subject> {
 protected:
  // Runs that many steps, expects all demands, and gives the end.
  std::unique_ptr<FlowModel> run(const Case& c, int steps, const std::string& what = "") const {
    auto solver = c.build(GetParam());
    Demands demands(c, GetParam(), *solver);
    demands.run(steps);
    demands.expect(what);
    return solver;
  }
};

// The whole state, to compare bit by bit.
inline Bits bits_of(const FlowModel& s) {
  Bits b;
  s.gather(b.h, b.hu, b.hv);
  return b;
}

inline std::string subject_name(const testing::TestParamInfo<Subject>& info) {
  return info.param.name;
}

inline Closure granular(double phi, double delta) {
  return {EarthPressure::active_passive(degrees(phi), degrees(delta)), std::tan(degrees(delta)), true};
}

inline double heap(double x, double y, double depth, double radius) {
  return std::max(0.0, depth * (1 - (x * x + y * y) / (radius * radius)));
}

}  // namespace couloir::test
