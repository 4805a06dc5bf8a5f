#pragma once
// A scene's grains -> the engine's set-up: material, meshes, box, faces.

#include <array>

#include "continuum/terrain/reference_surface.hpp"
#include "coupling/engine/packing.hpp"
#include "coupling/loop/meshes.hpp"
#include "coupling/plan/zone.hpp"
#include "coupling/scene/scene.hpp"
#include "coupling/transfer/rim.hpp"

namespace couloir {

// The packing from which this scene's flows of grains are cut; deep enough for `depth` [m].
PackingSpec packing_spec(const Scene&, double depth);

// rho_bulk / solid fraction, so that both models weigh the same [kg/m3].
double grain_density(const Scene&, const Packing&);

// Names of the surfaces that stand at closed sides of the domain.
inline constexpr std::array<const char*, 4> side_surfaces{"side_left", "side_right", "side_upstream", "side_downstream"};

// Whole chute: every side of the domain that is open is extended, so that grains pass it before they are taken out.
EngineSetup engine_setup_whole(const Scene&, const ReferenceSurface&, double grain_density, const std::string& work_dir);

// A zone and all that it may grow to, with the rim that it has now.
EngineSetup engine_setup_zone(const Scene&, const ReferenceSurface&, const PlannedZone&, const Rim&, double grain_density,
                              const std::string& work_dir);

}  // namespace couloir
