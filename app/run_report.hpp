#pragma once
#include <string>
#include <vector>

namespace couloir {

// Draws the report of one run, or of several side by side. `out` empty: RUN/report, or for several runs a folder beside the
// first. Returns the page's path. Throws SceneError where a run is not one, std::runtime_error with the script's words where it
// fails.
std::string draw_report(const std::vector<std::string>& runs, const std::string& out);

}  // namespace couloir
