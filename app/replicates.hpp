#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "coupling/records/run_folder.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// The further packings of a run that is done (grains.replicates): each a run of its own below <run>/replicates, as many at a time
// as there are cores. Puts "replicates" (coupling/cases/packings.hpp) into the run's summary.json. Returns the exit code: 0; 3
// where one failed or the user stopped it, which is told on stderr.
int run_replicates(const RunFolder&, const Scene&, bool quiet);

// The runs' folders by their seeds, as summary.json has them. Throws SceneError, with what to do, where that names not just the
// scene's seeds, each with the folder of a run.
std::map<long, std::string> packing_folders(const RunFolder&, const Scene&);

// "wall: peak 5.03 +- 0.04 N, ..." for each obstacle of summary.json's "replicates".
std::string replicates_text(const nlohmann::json& replicates);

}  // namespace couloir
