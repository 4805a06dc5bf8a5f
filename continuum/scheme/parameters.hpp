#pragma once
// What is the same for every block and every step.

#include <array>

#include "continuum/boundary/side.hpp"
#include "continuum/flow/closure.hpp"
#include "continuum/mesh/grid.hpp"
#include "continuum/scheme/limiter.hpp"

namespace couloir {

struct Parameters {
  Grid grid;
  Closure closure;
  Limiter limiter = Limiter::minmod;
  std::array<Side, 4> sides{};
  double dry_depth = 0;        // [m]
  std::array<bool, 4> shut{};  // inflow sides through which nothing comes now: walls
  bool wall(int side) const { return shut[side] || sides[side].kind == Side::Kind::wall; }
};

}  // namespace couloir
