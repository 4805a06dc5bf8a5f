#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/python_script.hpp"
#include "app/run_report.hpp"
#include "app/scene_options.hpp"
#include "app/verbs.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {

std::string draw_report(const std::vector<std::string>& runs, const std::string& out) {
  for (const std::string& run : runs)
    if (!std::filesystem::exists(std::filesystem::path(run) / "records.h5"))
      throw SceneError(run + " is not a run folder: it holds no records.h5; give a folder that `couloir run` made");
  std::filesystem::path folder = out;
  if (out.empty()) {
    const std::filesystem::path first(runs.front());
    folder =
        runs.size() == 1 ? first / "report" : std::filesystem::absolute(first).lexically_normal().parent_path() / "comparison";
  }
  std::vector<std::string> words = runs;
  words.insert(words.end(), {"--out", folder.string()});
  run_python(report_script("report.py"), words, "the report could not be drawn");
  return (folder / "index.html").string();
}

void add_report(CLI::App& app, int&) {
  struct Options {
    std::vector<std::string> runs;
    std::string out;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("report", "pictures and tables of one run, or of several side by side");
  verb->add_option("RUN", options->runs, "run folders")->required();
  verb->add_option("--out", options->out, "folder for the page and its pictures");
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options] {
    const std::string page = draw_report(options->runs, options->out);
    if (options->json)
      std::printf("%s\n", nlohmann::json{{"report", page}}.dump().c_str());
    else
      std::printf("report: %s\n", page.c_str());
  });
}

}  // namespace couloir
