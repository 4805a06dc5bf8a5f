#pragma once
// Where grains replace the continuum.

#include <string>

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

// Around all obstacles, on cell lines, cut off at the domain:
//
//         |<---- before ---->|##|<- behind ->|     before = max(2 H, 30 d, 10 h; 15 h where Fr < 2: a weak jump runs far)
//         |                  |##|            |     beside = max(0.3 H, 8 d, 4 h)
//         x0             obstacle            x1    behind = max(0.25 H, 5 d)
//
// H obstacle height, d grain diameter, h and Fr of the flow that is expected there (flow_estimate.hpp). It does not reach into a
// finite release while that leaves 10 d. A side closer to the domain's than 6 d moves onto it. Needs an obstacle: throws
// SceneError.
ZoneBox automatic_zone(const Scene&);

// The scene's own box or the automatic one.
PlannedZone planned_zone(const Scene&);

}  // namespace couloir
