#pragma once
// What an exact solution in one dimension says of a point.

namespace couloir::exact {

struct DepthVelocity {
  double h = 0, u = 0;  // [m], [m/s]
};

}  // namespace couloir::exact
