#include "coupling/records/run_folder.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>

#include "coupling/checkpoint/checkpoint_folder.hpp"
#include "coupling/records/record_error.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;

fs::path free_default(const Scene& scene) {
  const fs::path runs = "runs";
  const std::string base = scene_name(scene) + "-" + to_string(scene.mode);
  fs::path path = runs / base;
  for (int k = 2; fs::exists(fs::symlink_status(path)); ++k) path = runs / fmt::format("{}-{}", base, k);
  return path;
}

// The nearest thing on the way to `path` that exists.
fs::path nearest(fs::path path) {
  path = fs::absolute(path);
  std::error_code error;
  while (!fs::exists(path, error) && path.has_relative_path()) path = path.parent_path();
  return path;
}

void make_folder(const fs::path& path) {
  const fs::path there = nearest(path);
  if (!fs::is_directory(there))
    throw SceneError(fmt::format("{} cannot be made: {} is a file; choose another --out", path.string(), there.string()));
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw SceneError(
        fmt::format("{} cannot be made: {} ({}); choose another --out", path.string(), error.message(), there.string()));
}

}  // namespace

std::string scene_name(const Scene& scene) {
  fs::path file = fs::path(scene.file).lexically_normal();
  if (!file.has_filename()) file = file.parent_path();
  if (file.filename() == "scene.yaml" || file.filename() == ".") file = fs::absolute(file).lexically_normal().parent_path();
  const std::string name = file.stem().string();
  return name.empty() ? "scene" : name;
}

RunFolder RunFolder::create(const Scene& scene, const std::string& out, const std::string& scene_text) {
  const fs::path path = out.empty() ? free_default(scene) : fs::path(out);
  make_folder(path);
  std::error_code error;
  if (!fs::is_empty(path, error) && !error) {
    const bool unfinished = CheckpointFolder::holds_one((path / "checkpoint").string());
    throw SceneError(
        path.string() + " exists and is not empty; " +
        (unfinished ? "it holds an unfinished run, with which couloir resume " + path.string() + " goes on; or " : "") +
        "choose another --out or remove it");
  }
  const RunFolder folder(path);
  try {
    write_atomically(folder.file("scene.yaml"), scene_text);
  } catch (const RecordError&) {
    throw SceneError(fmt::format("{} cannot be written to: {}; choose another --out", path.string(), std::strerror(errno)));
  }
  return folder;
}

RunFolder RunFolder::open(const std::string& path) {
  if (!fs::is_directory(path)) throw SceneError(path + " is no folder; name the folder of a run");
  if (!fs::exists(fs::path(path) / "records.h5"))
    throw SceneError(path + " holds no records.h5, so it is not the folder of a run; name one that `couloir run` made");
  return RunFolder(path);
}

}  // namespace couloir
