#pragma once
// Depths that count as something, as shares of the greatest depth of release and inflows, so that a film of 5 mm and an avalanche
// of 5 m are read alike.

#include "coupling/scene/scene.hpp"

namespace couloir {

// [m] of the release as scaled to its mass, and of what comes in.
double greatest_depth(const Scene&);

// [m] A film thinner than that carries mass but no momentum: 1e-6 of it.
double dry_depth(const Scene&);
// [m] Up to here records show no velocity: 1e-5 of it.
double thin_depth(const Scene&);
// [m] From here on the flow has arrived at a gauge: 1 % of it.
double arrival_depth(const Scene&);

}  // namespace couloir
