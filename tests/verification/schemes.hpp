#pragma once
// The solvers that every exact case is run with: one struct each, listed in Schemes.

#include <gtest/gtest.h>

#include "continuum/solver.hpp"
#include "tests/continuum/scenes.hpp"

namespace couloir::test {

struct CentralUpwind {
  static constexpr const char* name = "central_upwind";
  static constexpr Limiter plain = Limiter::minmod;     // what runs use by default
  static constexpr Limiter smooth = Limiter::van_leer;  // for beds with relief, docs/decisions/0007
  static constexpr double order_smooth = 1.8, order_shock = 0.9;
  static Solver make(const SolverSettings& s, const ReferenceSurface& surface, const StepBed& bed = {}) {
    return Solver(s, surface, bed);
  }
};

using Schemes = ::testing::Types<CentralUpwind>;

struct SchemeNames {
  template <class S>
  static std::string GetName(int) {
    return S::name;
  }
};

// A case's fixture: TYPED_TEST_SUITE(Case, Schemes, SchemeNames).
template <class S>
class SchemeTest : public ::testing::Test {};

// One row of cells from x0, frictionless, hydraulic.
template <class S>
SolverSettings row(int nx, double x0, double length, Side::Kind ends) {
  SolverSettings s;
  s.grid = {nx, 1, length / nx, length / nx, x0, 0};
  s.sides = sides(ends, Side::Kind::wall);
  s.limiter = S::plain;
  return s;
}

}  // namespace couloir::test
