#include "app/scene_options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <thread>

#include "coupling/scene/reader.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

Overrides overrides_of(const std::vector<std::string>& set) {
  Overrides out;
  for (const std::string& s : set) {
    const auto at = s.find('=');
    if (at == std::string::npos || at == 0)
      throw SceneError("--set " + s + ": a key and a value are needed, as in --set grains.seed=7");
    out.emplace_back(s.substr(0, at), s.substr(at + 1));
  }
  return out;
}

}  // namespace

void SceneOptions::declare(CLI::App& verb) {
  verb.add_option("SCENE", path, "a scene file, or an experiment's folder")->required();
  verb.add_option("--mode", mode, "continuum, coupled or grains; instead of the scene's own");
  verb.add_option("--set", set, "key=value, instead of the scene's own; may be given more than once")
      ->take_all()
      ->allow_extra_args(false);
}

Overrides SceneOptions::overrides() const {
  Overrides out;
  if (!mode.empty()) out.emplace_back("mode", mode);
  const Overrides given = overrides_of(set);
  out.insert(out.end(), given.begin(), given.end());
  return out;
}

Scene SceneOptions::read() const {
  return read_scene(path, materials_folder(), overrides());
}

double share_of(const std::string& option, const std::string& text, const std::string& example) {
  try {
    const auto [number, unit] = parse_case_value(text);
    if ((unit.text.empty() || unit.text == "%") && number >= 0) return number * unit.si;
  } catch (const std::invalid_argument&) {  // said below
  }
  throw SceneError(fmt::format("{} {}: must be a share of at least 0, such as {}", option, text, example));
}

void CaseOptions::declare(CLI::App& verb, const std::string& quick_help, const std::string& json_help) {
  verb.add_flag("--quick", quick, quick_help);
  verb.add_option("--variant", variants, "only this variant; may be given more than once")->take_all()->allow_extra_args(false);
  verb.add_option("--set", set, "key=value for every run, after all that the file sets; may be given more than once")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--jobs", jobs, "runs at a time; default: as many as there are cores")->check(CLI::Range(1, 256));
  verb.add_option("--runs", runs, "folder of the runs, which are kept and used again");
  verb.add_flag("--json", json, json_help);
}

const std::string& CaseOptions::runs_folder() const {
  std::error_code error;
  std::filesystem::create_directories(runs, error);
  if (!error && ::access(runs.c_str(), W_OK) != 0) error = {errno, std::generic_category()};
  if (error)
    throw SceneError(fmt::format("--runs {}: cannot be made or written: {}; give another folder", runs, error.message()));
  return runs;
}

CaseChoice CaseOptions::choice() const {
  return {quick, variants, overrides_of(set)};
}

std::string own_program() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

int jobs_or_cores(int given) {
  return given > 0 ? given : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string materials_folder() {
  return COULOIR_SOURCE_DIR "/dem_inputs/materials";
}
std::string packings_folder() {
  return COULOIR_SOURCE_DIR "/.cache/packings";
}
std::string plot_cache_folder() {
  return COULOIR_SOURCE_DIR "/.cache/matplotlib";
}
std::string report_script(const std::string& name) {
  return COULOIR_SOURCE_DIR "/app/report/" + name;
}

}  // namespace couloir
