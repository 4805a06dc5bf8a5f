#pragma once
// What the parts of a run cost, each with the effect (coupling/plan/effects.cpp) that it is there for.

#include <vector>

#include "continuum/scheme/step_parts.hpp"
#include "coupling/loop/observer.hpp"

namespace couloir {

// Of the solver's parts: the effect that alone asks for this one; depth_averaged_flow where the flow itself does.
const char* effect_of(StepPart);

// Parts that took no time are left out.
std::vector<PartCost> costs_of(const PartTimes&);

// [s] of all; and so that all are `seconds`.
double sum(const std::vector<PartCost>&);
void scale_to(std::vector<PartCost>&, double seconds);

}  // namespace couloir
