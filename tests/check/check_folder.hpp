#pragma once
// An experiment in a folder of its own, gone with the object: slab, with the scene of tests/scenes.

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
    std::filesystem::copy_file(COULOIR_SOURCE_DIR "/tests/scenes/slab.yaml", path_ / "slab/scene.yaml");
  }
  ~CheckFolder() { std::filesystem::remove_all(path_); }

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace couloir
