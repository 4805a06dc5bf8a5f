#pragma once
#include <array>

namespace couloir {

// The effects that a run may have, in the order in which a plan lists them; coupling/plan/effects.cpp says when they are on.
inline constexpr std::array effect_names{"depth_averaged_flow", "across_slope",   "refinement",       "gravity_along_slope",
                                         "earth_pressure",      "basal_friction", "curvature",        "steps_of_the_bed",
                                         "elevation",           "planes",         "solid_bodies",     "inflow",
                                         "periodic_sides",      "grain_engine",   "rolling_friction", "rotation_control",
                                         "side_friction",       "coupling",       "airborne"};

}  // namespace couloir
