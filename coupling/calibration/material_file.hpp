#pragma once
// Calibrated frictions in a material's file, which then names its record.

#include <string>

#include "coupling/calibration/record.hpp"

namespace couloir {

// The file's text with the four frictions of the record in `grains` and `calibration: <record_name>`. Other keys, and comments
// that do not stand right above `grains`, stay as they are; what `source` says after "Grain parameters:" is said anew.
std::string with_calibration(const std::string& text, const CalibrationRecord&, const std::string& record_name);

// Those lines alone, to be put below `material:` of a scene.
std::string grains_block(const CalibrationRecord&);

}  // namespace couloir
