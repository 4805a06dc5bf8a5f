#pragma once
// Which continuum solver a scene asks for.

#include <memory>

#include "continuum/flow_model.hpp"
#include "continuum/terrain/reference_surface.hpp"
#include "continuum/terrain/step_bed.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// The obstacle that is made of planes in this scene's continuum; -1: none.
int planes_obstacle(const Scene&);

std::unique_ptr<FlowModel> flow_model(const Scene&, const ReferenceSurface&, const StepBed&, int threads, const Ranks& = {});

}  // namespace couloir
