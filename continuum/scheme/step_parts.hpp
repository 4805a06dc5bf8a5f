#pragma once
// The parts of a step, and what they take.

#include <array>
#include <cstddef>

namespace couloir {

enum class StepPart {
  mesh,            // another mesh, blocks to ranks
  levels,          // what crosses between cells of two sizes
  order,           // which blocks step, sums over blocks and ranks
  ghosts,          // copies from neighbours and sides
  velocities,      // momentum over depth
  rates,           // the fastest signal, for the time step
  earth_pressure,  // K of each cell, carried along and following the strain
  rest,            // which cells friction holds still
  shocks,          // where friction asks for a flat reconstruction
  reconstruction,
  bed,        // what only a bed with relief asks for
  bed_steps,  // jumps of the bed
  fluxes,     // through the faces
  sides,      // of the domain
  zone_rims,  // of covered zones
  measures,   // gauges and control volumes
  update,     // new state, with weight and friction; sums
  planes,     // flows on an obstacle's planes
};
inline constexpr int part_count = 18;
const char* to_string(StepPart);
using PartTimes = std::array<double, part_count>;  // [s] by StepPart

inline double& at(PartTimes& times, StepPart part) {
  return times[static_cast<std::size_t>(part)];
}
inline void add(PartTimes& all, const PartTimes& more) {
  for (int p = 0; p < part_count; ++p) all[p] += more[p];
}
inline double sum(const PartTimes& times) {
  double all = 0;
  for (const double t : times) all += t;
  return all;
}

}  // namespace couloir
