#include "coupling/loop/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/replicates.hpp"
#include "app/run_report.hpp"
#include "app/scene_options.hpp"
#include "app/stop_signal.hpp"
#include "app/verbs.hpp"
#include "coupling/engine/worker_engine.hpp"
#include "coupling/plan/limits.hpp"
#include "coupling/records/console.hpp"
#include "coupling/records/forces_csv.hpp"
#include "coupling/records/records.hpp"
#include "coupling/records/run_folder.hpp"
#include "coupling/records/summary.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/records/xdmf.hpp"
#include "coupling/scene/reader.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

struct Begun : Observer {
  bool yes = false;
  void on_window(const WindowReport&) override { yes = true; }
};

struct RunVerb {
  SceneOptions scene;
  std::string out;
  int threads = 1, ranks = 1;
  bool json = false, no_report = false;
};

void print_result(const RunFolder& folder, const nlohmann::json& summary, const std::string& page) {
  for (const auto& [name, o] : summary.at("obstacles").items())
    fmt::print("{}: peak {:.4g} N, mean {:.4g} N, impulse {:.4g} N s\n", name, o.value("force_peak", 0.0),
               o.value("force_mean", 0.0), o.value("impulse", 0.0));
  if (summary.contains("replicates")) fmt::print("{}", replicates_text(summary.at("replicates")));
  fmt::print("mass: relative error {:.1e}\n", summary.at("mass").value("relative_error", 0.0));
  fmt::print("run: {}\n", folder.path().string());
  if (!page.empty()) fmt::print("report: {}\n", page);
}

Ranks ranks_for(const RunVerb& verb, const Scene& scene) {
  if (verb.ranks == 1) return {};
  const Ranks ranks = Ranks::of_program();
  if (ranks.count() != verb.ranks) {
    throw SceneError(fmt::format("--ranks {}: the program runs on {} rank{}; start it as ./couloir run, which calls mpirun",
                                 verb.ranks, ranks.count(), ranks.count() == 1 ? "" : "s"));
  }
  const bool planes =
      std::ranges::any_of(scene.obstacles, [](const auto& o) { return o.method == ObstacleSpec::Method::planes; });
  if (scene.mode != Mode::continuum || scene.continuum.scheme != "central_upwind" || planes) {
    throw SceneError(
        fmt::format("--ranks {}: several ranks share the continuum of scheme central_upwind, without planes, in mode "
                    "continuum; use --threads here{}",
                    verb.ranks, scene.mode == Mode::continuum ? "" : ", and grains.ranks for the engine"));
  }
  return ranks;
}

// True as soon as one of the ranks has been told to stop.
bool any_told_to_stop(const Ranks& ranks) {
  std::vector<char> told{static_cast<char>(told_to_stop())};
  ranks.any(told);
  return told[0] != 0;
}

int run(const RunVerb& verb) {
  const Scene scene = verb.scene.read();
  const Ranks ranks = ranks_for(verb, scene);
  check_memory(scene, make_plan(scene), verb.ranks);
  const std::string text = write_scene(scene);
  RunOptions options;
  options.threads = verb.threads;
  options.ranks = ranks;
  note_stop_signals();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is then a write error, with its sentence
  options.interrupted = [ranks] { return any_told_to_stop(ranks); };
  if (!ranks.first()) return run_scene(scene, options, {}).status == "done" ? 0 : 3;

  const RunFolder folder = RunFolder::create(scene, verb.out, text);
  const std::string work = folder.file("engine");
  std::filesystem::create_directories(work);
  options.work_dir = work;
  options.workers = default_worker_folder();
  options.packings = packings_folder();

  ConsoleSettings screen;
  screen.terminal = isatty(fileno(stderr));
  screen.quiet = verb.json;
  RunEnd end;
  Summary summary(folder.file("summary.json"));
  Begun begun;
  try {
    Records records(folder.file("records.h5"), text);
    Xdmf xdmf(folder.path().string());
    ForcesCsv forces(folder.file("forces.csv"));
    Console console(folder.file("log.txt"), screen);
    // Records flush a frame before Xdmf names it; the summary is last, so that its being there means that all else is.
    end = run_scene(scene, options, {&begun, &records, &xdmf, &forces, &console, &summary});
  } catch (...) {
    if (std::filesystem::exists(folder.file("summary.json")))
      fmt::print(stderr, "couloir: what was computed is in {}; the last state that could be saved is in {}\n",
                 folder.path().string(), work);
    else
      fmt::print(
          stderr, "couloir: {} {}\n",
          begun.yes ? "there is no summary; what was recorded until then is in" : "nothing was computed yet; the log is in",
          folder.path().string());
    throw;
  }  // all files are closed before the report reads them
  if (end.status == "interrupted")
    fmt::print(stderr, "couloir: interrupted; what was computed is in {}, the state is saved in {}\n", folder.path().string(),
               work);

  int exit_code = end.status == "done" ? 0 : 3;
  if (exit_code == 0 && scene.grains.replicates > 1 && scene.mode != Mode::continuum)
    exit_code = run_replicates(folder, scene, verb.json);

  const auto result = nlohmann::json::parse(read_text(folder.file("summary.json")));
  std::string page;
  if (!verb.no_report) page = draw_report({folder.path().string()}, "");
  if (verb.json) {
    auto json = result;
    json["run"] = folder.path().string();
    json["report"] = page;
    fmt::print("{}\n", json.dump(2));
  } else {
    print_result(folder, result, page);
  }
  return exit_code;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunVerb>();
  CLI::App* verb = app.add_subcommand("run", "run a scene and draw its report");
  options->scene.declare(*verb);
  verb->add_option("--out", options->out, "the run's folder; default: runs/<scene>-<mode>");
  verb->add_option("--threads", options->threads, "of the solver; any number gives the same bits")->check(CLI::Range(1, 256));
  verb->add_option("--ranks", options->ranks, "MPI processes that share the continuum; any number gives the same bits")
      ->check(CLI::Range(1, 1024));
  verb->add_flag("--no-report", options->no_report, "leave out the pictures (couloir report draws them later)");
  verb->add_flag("--json", options->json, "print the summary alone, machine-readable");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace couloir
