#pragma once
// The stress gauges that a run reads: surfaces of their own in the engine.

#include <string>
#include <vector>

#include "coupling/loop/observer.hpp"
#include "coupling/plan/zone.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// Those on obstacles that grains meet, in the scene's order: in mode grains all, in mode coupled those that a zone holds, in
// mode continuum none.
std::vector<StressGauge> stress_gauges(const Scene&, const std::vector<PlannedZone>& zones);

// As the engine's surface is called.
std::string surface_of(const StressGauge&);

}  // namespace couloir
