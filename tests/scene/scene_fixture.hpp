#pragma once
// Scenes from texts, and the sentence that the user reads when one is wrong.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "coupling/scene/reader.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {

inline const std::string materials_folder = std::string(COULOIR_SOURCE_DIR) + "/dem_inputs/materials";

class SceneFixture : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("couloir_") + info->test_suite_name() + "_" + info->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file() const { return (folder_ / "scene.yaml").string(); }

  Scene read(const std::string& text, const Overrides& overrides = {}) const {
    std::ofstream(file()) << text;
    return read_scene(file(), materials_folder, overrides);
  }

  // The error's sentence with the folder cut off, so that it starts "scene.yaml:14: ". Empty: there was none.
  std::string error(const std::string& text, const Overrides& overrides = {}) const {
    try {
      read(text, overrides);
    } catch (const SceneError& e) {
      std::string what = e.what();
      const std::string prefix = folder_.string() + "/";
      for (auto at = what.find(prefix); at != std::string::npos; at = what.find(prefix)) what.erase(at, prefix.size());
      return what;
    }
    return "";
  }

  std::filesystem::path folder_;
};

// Complete, in mode coupled. Each line has its number for the messages.
inline const std::string good_scene =
    "mode: coupled\n"                                                                                // 1
    "terrain: {kind: incline, angle: 35 deg, length: 2 m, width: 0.5 m}\n"                           // 2
    "material: vestolen\n"                                                                           // 3
    "release: {kind: block, position: [0.1 m, 0], length: 300 mm, width: 200 mm, height: 100 mm}\n"  // 4
    "obstacles:\n"                                                                                   // 5
    "  wall: {position: [1.2 m, 0], size: [20 mm, 100 mm, 80 mm]}\n"                                 // 6
    "boundaries: {left: wall, right: wall}\n"                                                        // 7
    "continuum:\n"                                                                                   // 8
    "  cell: 10 mm\n"                                                                                // 9
    "grains:\n"                                                                                      // 10
    "  diameter: 5 mm\n"                                                                             // 11
    "duration: 1 s\n";                                                                               // 12

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test's scene does not hold '" + from + "'");
  return text.replace(at, from.size(), to);
}

}  // namespace couloir
