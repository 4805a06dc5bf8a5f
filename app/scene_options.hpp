#pragma once
// The options that every verb that takes a SCENE shares.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "coupling/cases/case_reader.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

struct SceneOptions {
  std::string path, mode;
  std::vector<std::string> set;

  void declare(CLI::App&);
  Overrides overrides() const;  // both throw SceneError
  Scene read() const;
};

// Those that check and study share: which cases, and how their runs are made.
struct CaseOptions {
  std::vector<std::string> variants, set;
  std::string runs = "runs/check";
  int jobs = 0;
  bool quick = false, json = false;

  // `quick_help`, `json_help`: what the two flags do for this verb.
  void declare(CLI::App&, const std::string& quick_help, const std::string& json_help);
  CaseChoice choice() const;  // throws SceneError
  // The folder of the runs, made where it is missing. Throws SceneError.
  const std::string& runs_folder() const;
};

// A share, as after an option: "2 %", "1e-6". Throws SceneError, with the example.
double share_of(const std::string& option, const std::string& text, const std::string& example);

// The program itself, for runs in processes of their own.
std::string own_program();
// Runs at a time: as given, or (0) as many as there are cores.
int jobs_or_cores(int given);

// Folders of this checkout.
std::string materials_folder();
std::string packings_folder();
std::string plot_cache_folder();
std::string report_script(const std::string& name);

}  // namespace couloir
