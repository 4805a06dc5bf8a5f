#pragma once
// Where grains replace the continuum.

#include <algorithm>
#include <string>
#include <vector>

#include "continuum/solver.hpp"
#include "coupling/plan/zone_growth.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

struct PlannedZone {
  ZoneBox box;         // on cell lines
  CellBox cells;       // the same
  std::string reason;  // one sentence with the numbers
  ZoneLines lines;     // how far it may grow
};

// The scene's own boxes; or around the obstacles, on cell lines, cut off at the domain:
//
//         |<---- before ---->|##|<- behind ->|     before = max(2 H, 30 d, 10 h; 15 h where Fr < 2: a weak jump runs far)
//         |                  |##|            |     beside = max(0.3 H, 8 d, 4 h)
//         x0             obstacle            x1    behind = max(0.25 H, 5 d)
//
// around those obstacles at which the shallow model fails (validity.hpp), or around all where it fails at none. H obstacle
// height, d grain diameter, h and Fr of the flow that is expected there (flow_estimate.hpp). It does not reach into a finite
// release while that leaves 10 d. A side closer to the domain's than 6 d moves onto it. Obstacles whose zones would be nearer
// than 40 d share one. Throws SceneError where there is neither a box nor an obstacle.
//
// Mode grains with an inflow: the whole domain but a strip along each side through which material comes in. There a shallow flow
// brings it to the grains: four cells, and room for the driven layer.
std::vector<PlannedZone> planned_zones(const Scene&);
inline bool feeds_grains_alone(const Scene& s) {
  return s.mode == Mode::grains && s.fed();
}
inline bool has_zones(const Scene& s) {
  return s.mode == Mode::coupled || feeds_grains_alone(s);
}

// Whether some zone holds the whole obstacle; whether all leave it out.
inline bool any_holds(const std::vector<PlannedZone>& zones, const ObstacleSpec& o) {
  return std::ranges::any_of(zones, [&](const PlannedZone& z) { return z.box.holds(o); });
}
inline bool all_apart(const std::vector<PlannedZone>& zones, const ObstacleSpec& o) {
  return std::ranges::all_of(zones, [&](const PlannedZone& z) { return z.box.apart(o); });
}

}  // namespace couloir
