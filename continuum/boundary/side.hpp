#pragma once
// What a side of the domain does to the flow.

namespace couloir {

enum class SideName { upstream = 0, downstream = 1, left = 2, right = 3 };

struct Side {
  enum class Kind { wall, outflow, periodic, inflow } kind = Kind::outflow;
  double depth = 0;     // [m] inflow only
  double velocity = 0;  // [m/s] inflow only, inward positive
};

}  // namespace couloir
