#pragma once
#include <string>
#include <vector>

namespace couloir {

// Runs a script of app/report and waits for it. Throws SceneError where it finds its input wrong (exit code 2), RecordError where
// it fails otherwise; its own words stand on the screen. `what` begins the sentence: "the report could not be drawn".
void run_python(const std::string& script, const std::vector<std::string>& words, const std::string& what);

}  // namespace couloir
