#pragma once
// scene.yaml -> Scene. All errors are SceneError with file, line, key, and remedy. Of the YAML library only document.cpp knows.

#include <string>
#include <utility>
#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

using Overrides = std::vector<std::pair<std::string, std::string>>;  // "grains.seed" -> "7", as from --set

// `path`: a scene file, or a folder that holds scene.yaml. `materials`: the folder of material files.
// Checks every key, unit and bound, and the scene as a whole (check.hpp).
Scene read_scene(const std::string& path, const std::string& materials, const Overrides& = {});

// The same of a text that write_scene made: a run's record has one, which needs no other file. `file`: that it came from.
Scene read_scene_text(const std::string& text, const std::string& file, const std::string& materials);

// A material of that folder alone. Throws SceneError.
Material read_material(const std::string& name, const std::string& materials);

// The scene as YAML text, complete, SI units, every default written out; read_scene reads it back to the same Scene.
std::string write_scene(const Scene&);

}  // namespace couloir
