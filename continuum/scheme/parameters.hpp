#pragma once
// What is the same for every block and every step.

#include <array>

#include "continuum/boundary/side.hpp"
#include "continuum/flow/closure.hpp"
#include "continuum/scheme/limiter.hpp"

namespace couloir {

struct Parameters {
  Closure closure;
  Limiter limiter = Limiter::minmod;
  std::array<Side, 4> sides{};
  double dry_depth = 0;                 // [m]
  std::array<InflowPoint, 4> inflow{};  // through each inflow side, now
  std::array<double, 4> discharge{};    // [m2/s] through it, the mean over the step
  bool comes_in(int side) const {
    return sides[side].kind == Side::Kind::inflow && (inflow[side].depth > 0 || discharge[side] > 0);
  }
  // An inflow side through which nothing comes is one.
  bool wall(int side) const {
    return sides[side].kind == Side::Kind::wall || (sides[side].kind == Side::Kind::inflow && !comes_in(side));
  }
};

}  // namespace couloir
