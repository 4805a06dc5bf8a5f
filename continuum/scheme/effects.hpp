#pragma once
// Which effects a block's flow has. They are asked for once a block and stage, outside of the inner loops: what a scene leaves
// out is neither computed nor looked at (bench/effects_rate.cpp measures it).

#include "continuum/mesh/block.hpp"
#include "continuum/scheme/parameters.hpp"

namespace couloir {

// What this build can do: all. Only the programs of bench/effects_rate.cpp to compare with are built without.
namespace built {
#ifdef COULOIR_BARE
inline constexpr bool all = false;
#else
inline constexpr bool all = true;
#endif
#ifdef COULOIR_WITHOUT_CURVATURE
inline constexpr bool curvature = false;
#else
inline constexpr bool curvature = all;
#endif
inline constexpr bool friction = all, earth_pressure = all, relief = all;
}  // namespace built

inline bool with_friction(const Parameters& p) {
  return built::friction && p.closure.tan_delta > 0;
}
inline bool with_earth_pressure(const Parameters& p) {
  return built::earth_pressure && !p.closure.earth_pressure.is_hydraulic();
}
inline bool with_relief(const Block& b) {
  return built::relief && b.relief;
}
// Whether Scratch::smooth says anything: only friction (shocks) and relief (feet of walls) make a cell flat.
inline bool with_flattening(const Parameters& p, const Block& b) {
  return with_friction(p) || with_relief(b);
}

}  // namespace couloir
