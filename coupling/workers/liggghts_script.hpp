#pragma once
// An engine set-up in the engine's own input language.

#include <string>
#include <vector>

#include "coupling/engine/grain_engine.hpp"

namespace couloir {

// The commands, in order, up to where the first run would be. Surface k is the fix mesh_k.
// With a checkpoint, the box, the grains and the step come from that file; without, the run begins at `step`.
std::vector<std::string> liggghts_script(const EngineSetup&, const std::string& checkpoint, std::int64_t step);

// Writes the surfaces as STL files, as the script names them. Throws EngineFailure.
void write_surfaces(const EngineSetup&);

}  // namespace couloir
