#pragma once
// What a scene will run, why, and what it will cost. Builds everything, computes nothing.

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "continuum/solver.hpp"
#include "coupling/plan/effect.hpp"
#include "coupling/plan/flow_estimate.hpp"
#include "coupling/plan/impact.hpp"
#include "coupling/plan/refined_mesh.hpp"
#include "coupling/plan/validity.hpp"
#include "coupling/plan/zone.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

struct Plan {
  std::string title;
  Mode mode = Mode::coupled;
  std::vector<Effect> effects;
  double release_volume = 0, release_mass = 0;  // [m3], [kg]
  Grid grid;                                    // nx = 0 in mode grains
  std::string scheme, limiter;                  // empty in mode grains
  std::string instruction_set;                  // of this machine's kernels; likewise
  std::int64_t cells = 0;                       // of all levels
  std::vector<LevelCells> levels;               // empty: cells of one size
  int followed_levels = 0;                      // how often cells may be halved where the mesh follows the flow
  std::int64_t followed_cells = 0;              // of all levels where the mesh follows the flow, roughly; else 0
  double dt = 0;                                // [s] least continuum step expected
  std::int64_t steps = 0;                       // at that step
  FlowEstimate at_obstacle;                     // flow expected at the first obstacle; without one at the terrain's end
  std::vector<ImpactEstimate> impacts;          // of each obstacle that the flow gets to
  double run_out = 0;                           // [m] where its middle stops; NaN: not on the terrain
  std::vector<ShallowVerdict> shallow;          // where the shallow model holds, all modes
  std::vector<PlannedZone> zones;               // mode coupled
  std::array<std::int64_t, 3> grains{};         // greatest number expected at once, by Mode; 0 where the scene has no diameter
  double engine_dt = 0;                         // [s] 0: no engine
  double youngs_modulus = 0;                    // [Pa] of the grains
  double impact_speed = 0, bunch_overlap = 0;   // [m/s] of the grains; [d] by which a bunch of them then overlaps at most
  std::int64_t engine_steps = 0;
  double memory = 0;                           // [bytes]
  double time_continuum = 0, time_engine = 0;  // [s] of one core at the speeds that plan.cpp states
  double time = 0;                             // [s] wall, both; of one packing
  int replicates = 1;                          // packings
  std::vector<std::string> stress_gauges;      // a line each: what is read there, or why nothing is
  std::vector<std::string> warnings;           // whole sentences
};

inline constexpr double bytes_of_engine = 6e7;  // of each rank, before its grains

// The scene must have passed check_scene. Throws SceneError where it asks too much of the engine (limits.hpp).
Plan make_plan(const Scene&);

std::string plan_text(const Plan&);
nlohmann::json plan_json(const Plan&);

}  // namespace couloir
