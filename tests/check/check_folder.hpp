#pragma once
// An experiment in a folder of its own, gone with the object.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace couloir {

class CheckFolder {
 public:
  explicit CheckFolder(const std::string& name)
      : path_(std::filesystem::path(COULOIR_BINARY_DIR) / "test_runs" / (name + "-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_ / "slab");
    write("slab/scene.yaml", scene);
  }
  ~CheckFolder() { std::filesystem::remove_all(path_); }

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

  // A block that slides down: u = m t with m = g (sin 30 - tan 20 cos 30), exact for its middle.
  static constexpr const char* scene = R"(mode: continuum
terrain: {kind: incline, angle: 30 deg, length: 1 m, width: 0.1 m}
material: {density: 1000 kg/m3, internal_friction_angle: 30 deg, basal_friction_angle: 20 deg}
release: {kind: block, position: [0.1 m, 0], length: 0.4 m, width: 0.1 m, height: 10 mm}
boundaries: {left: wall, right: wall}
continuum: {cell: 10 mm, closure: hydraulic}
record: {frames: 1 s, forces: 10 ms, gauges: {middle: {position: [0.35 m, 0]}}}
duration: 0.1 s
)";

 private:
  std::filesystem::path path_;
};

}  // namespace couloir
