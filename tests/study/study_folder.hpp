#pragma once
// A study of the slab of tests/check, read from a folder of its own.

#include <string>

#include "coupling/scene/scene_error.hpp"
#include "coupling/study/study.hpp"
#include "tests/check/check_folder.hpp"

namespace couloir {

inline Study read_slab_study(const std::string& text, const CaseChoice& choice = {}) {
  const CheckFolder folder("study");
  return read_study(folder.write("slab/study.yaml", text), choice, COULOIR_SOURCE_DIR "/dem_inputs/materials");
}

// What the user is told; empty: it is read.
inline std::string study_error(const std::string& text, const CaseChoice& choice = {}) {
  try {
    read_slab_study(text, choice);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace couloir
