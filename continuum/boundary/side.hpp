#pragma once
// What a side of the domain does to the flow.

#include <array>
#include <vector>

namespace couloir {

enum class SideName { upstream = 0, downstream = 1, left = 2, right = 3 };
inline constexpr SideName all_sides[] = {SideName::upstream, SideName::downstream, SideName::left, SideName::right};

constexpr bool is_low(SideName side) {
  return side == SideName::upstream || side == SideName::left;
}
constexpr bool is_across_x(SideName side) {  // its normal is along x
  return side == SideName::upstream || side == SideName::downstream;
}
constexpr SideName opposite(SideName side) {
  return static_cast<SideName>(static_cast<int>(side) ^ 1);
}

struct InflowPoint {
  double time = 0;      // [s]
  double depth = 0;     // [m]
  double velocity = 0;  // [m/s] inward
};

struct Side {
  enum class Kind { wall, outflow, periodic, inflow } kind = Kind::outflow;
  double depth = 0;     // [m] inflow only
  double velocity = 0;  // [m/s] inflow only, inward positive
  std::vector<InflowPoint>
      hydrograph{};  // inflow only, instead of both: linear between its points, nothing before and after them
};

// A hydrograph jumps at its first and its last row: what it is just before a time, or from it on.
enum class Moment { before, after };

// What comes in at a time [s]; its time is that time. Nothing: depth and velocity 0.
InflowPoint inflow_at(const Side&, double time, Moment = Moment::after);

// [m2/s] depth times velocity, the mean from one time to another with no row of the hydrograph between: both are linear there.
double mean_discharge(const Side&, double from, double to);

// [s] the first row of a hydrograph after a time, of a side or of all; infinity: there is none. No step should reach over it.
double next_row(const Side&, double time);
double next_row(const std::array<Side, 4>&, double time);

// [m/s] the greatest velocity + sqrt(g h) of an inflow from a time on; 0 where nothing more comes.
double fastest_inflow(const Side&, double gravity, double time);

}  // namespace couloir
