#pragma once
// The folder of one run and the names in it.
//
//   scene.yaml  records.h5  summary.json  forces.csv  flow.xdmf  grains.xdmf  log.txt  checkpoint/  engine/  report/
#include <filesystem>
#include <string>

#include "coupling/scene/scene.hpp"

namespace couloir {

class RunFolder {
 public:
  // Makes the folder and writes scene.yaml with `scene_text` (write_scene). `out` empty: runs/<scene>-<mode> below the present
  // folder, with -2, -3, ... where that is taken; missing parents are made. Throws SceneError where `out` exists and is not
  // empty, a file stands in the way, or the place cannot be written.
  static RunFolder create(const Scene&, const std::string& out, const std::string& scene_text);
  // The folder of an earlier run. Throws SceneError where there is none.
  static RunFolder open(const std::string& path);

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

// "wall" for scenes/wall.yaml and for experiments/wall/scene.yaml.
std::string scene_name(const Scene&);

}  // namespace couloir
