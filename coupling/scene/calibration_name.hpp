#pragma once
// What a record of couloir calibrate is called: it says what the frictions in it are those of.

#include <fmt/format.h>

#include <string>

#include "coupling/scene/scene.hpp"

namespace couloir {

// free, blocked, or control with its numbers: control-10ms, and what is not usual of chi, k_v, v_sr, v_rs.
inline std::string rotation_name(const GrainSpec& grains) {
  if (grains.rotation != "control") return grains.rotation;
  const RotationSpec& c = grains.control;
  std::string out = fmt::format("control-{:g}ms", 1000 * c.retarding_time);
  if (c.contact_influence != RotationSpec{}.contact_influence) out += fmt::format("-chi{:g}", c.contact_influence);
  if (c.shear_influence != 0) out += fmt::format("-kv{:g}", c.shear_influence);
  if (c.slide_to_roll != 0) out += fmt::format("-sr{:g}", c.slide_to_roll);
  if (c.roll_to_slide != 0) out += fmt::format("-rs{:g}", c.roll_to_slide);
  return out;
}

// diameter [m]. As in quartz-liggghts-5mm; a contact law but hertz and a rotation (rotation_name) but free are added.
inline std::string calibration_name(const std::string& material, const std::string& engine, const std::string& contact,
                                    const std::string& rotation, double diameter) {
  return fmt::format("{}-{}-{:g}mm{}{}", material, engine, 1000 * diameter, contact == "hertz" ? "" : "-" + contact,
                     rotation == "free" ? "" : "-" + rotation);
}

}  // namespace couloir
