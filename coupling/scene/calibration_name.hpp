#pragma once
// What a record of couloir calibrate is called: it says what the frictions in it are those of.

#include <fmt/format.h>

#include <string>

namespace couloir {

// diameter [m]. As in quartz-liggghts-5mm; a contact law but hertz and a rotation but free are added.
inline std::string calibration_name(const std::string& material, const std::string& engine, const std::string& contact,
                                    const std::string& rotation, double diameter) {
  return fmt::format("{}-{}-{:g}mm{}{}", material, engine, 1000 * diameter, contact == "hertz" ? "" : "-" + contact,
                     rotation == "free" ? "" : "-" + rotation);
}

}  // namespace couloir
