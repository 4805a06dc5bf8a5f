#pragma once
// The options that every verb that takes a SCENE shares.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

struct SceneOptions {
  std::string path, mode;
  std::vector<std::string> set;

  void declare(CLI::App&);
  Scene read() const;  // throws SceneError
};

// Folders of this checkout.
std::string materials_folder();
std::string packings_folder();
std::string plot_cache_folder();
std::string report_script();

}  // namespace couloir
