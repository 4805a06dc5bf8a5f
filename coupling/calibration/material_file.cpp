#include "coupling/calibration/material_file.hpp"

#include <fmt/format.h>

#include <sstream>
#include <vector>

namespace couloir {

namespace {

constexpr const char* found_keys[] = {"friction", "rolling_friction", "base_friction", "base_rolling_friction", "youngs_modulus"};

bool starts(const std::string& line, const std::string& word) {
  return line.rfind(word, 0) == 0;
}

bool is_found(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' ');
  if (first == std::string::npos) return true;
  for (const char* key : found_keys)
    if (line.compare(first, std::string(key).size() + 1, std::string(key) + ":") == 0) return true;
  return false;
}

std::string angle(const CalibratedAngle& a) {
  return fmt::format("{:.1f} +- {:.1f} deg of {:.1f} deg", a.reached, a.uncertainty, a.asked);
}

}  // namespace

std::string grains_block(const CalibrationRecord& r) {
  return fmt::format(
      "grains:\n  friction: {:.4g}\n  rolling_friction: {:.4g}\n  base_friction: {:.4g}\n  base_rolling_friction: {:.4g}\n"
      "  youngs_modulus: {:g} MPa\n",
      r.grains.friction, r.grains.rolling_friction, r.grains.base_friction, r.grains.base_rolling_friction,
      1e-6 * r.youngs_modulus);
}

std::string with_calibration(const std::string& text, const CalibrationRecord& r, const std::string& record_name) {
  std::vector<std::string> lines, comments, others;
  std::istringstream in(text);
  bool in_grains = false;
  for (std::string line; std::getline(in, line);) {
    in_grains = in_grains && (line.empty() || line[0] == ' ' || line[0] == '#');
    if (in_grains) {
      if (!is_found(line) && line[0] != '#') others.push_back(line);
    } else if (starts(line, "grains:")) {
      in_grains = true;
      comments.clear();
    } else if (starts(line, "#")) {
      comments.push_back(line);
    } else if (!starts(line, "calibration:")) {
      lines.insert(lines.end(), comments.begin(), comments.end());
      comments.clear();
      if (const auto at = line.find(" Grain parameters:"); starts(line, "source:") && at != std::string::npos)
        line = line.substr(0, at) + (line.back() == '\'' || line.back() == '"' ? std::string(1, line.back()) : "");
      lines.push_back(line);
    }
  }
  lines.insert(lines.end(), comments.begin(), comments.end());
  std::string out;
  for (const std::string& line : lines) out += line + '\n';
  out += fmt::format("calibration: {}\n", record_name);
  out += fmt::format("# Grains of {:g} mm show delta {}, phi {}.\n", 1000 * r.diameter, angle(r.delta), angle(r.phi));
  out += grains_block(r);
  for (const std::string& line : others) out += line + '\n';
  return out;
}

}  // namespace couloir
