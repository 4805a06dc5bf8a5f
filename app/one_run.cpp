#include "app/one_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/replicates.hpp"
#include "app/run_report.hpp"
#include "app/scene_options.hpp"
#include "app/stop_signal.hpp"
#include "coupling/checkpoint/checkpoint_folder.hpp"
#include "coupling/engine/worker_engine.hpp"
#include "coupling/loop/run.hpp"
#include "coupling/records/console.hpp"
#include "coupling/records/forces_csv.hpp"
#include "coupling/records/provenance.hpp"
#include "coupling/records/records.hpp"
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

void print_result(const RunFolder& folder, const nlohmann::json& summary, const std::string& page) {
  for (const auto& [name, o] : summary.at("obstacles").items())
    fmt::print("{}: peak {:.4g} N, mean {:.4g} N, impulse {:.4g} N s\n", name, o.value("force_peak", 0.0),
               o.value("force_mean", 0.0), o.value("impulse", 0.0));
  if (summary.contains("replicates")) fmt::print("{}", replicates_text(summary.at("replicates")));
  fmt::print("mass: relative error {:.1e}\n", summary.at("mass").value("relative_error", 0.0));
  fmt::print("run: {}\n", folder.path().string());
  if (!page.empty()) fmt::print("report: {}\n", page);
}

// True as soon as one of the ranks has been told to stop.
bool any_told_to_stop(const Ranks& ranks) {
  std::vector<char> told{static_cast<char>(told_to_stop())};
  ranks.any(told);
  return told[0] != 0;
}

RunOptions options_for(const OneRun& verb, const Ranks& ranks, const std::string& checkpoints) {
  RunOptions options;
  options.threads = verb.threads;
  options.ranks = ranks;
  options.checkpoints = checkpoints;
  options.made_by = build_identity(own_program());
  options.resume = verb.resume;
  note_stop_signals();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is then a write error, with its sentence
  options.interrupted = [ranks] { return any_told_to_stop(ranks); };
  return options;
}

// "couloir resume RUN goes on from t = 0.3 s", or nothing.
std::string way_on(const RunFolder& folder) {
  const std::string checkpoints = folder.file("checkpoint");
  try {
    return fmt::format("couloir resume {} goes on from t = {:.6g} s", folder.path().string(),
                       CheckpointFolder::read(checkpoints).time);
  } catch (const CheckpointError&) {
    return "";
  }
}

void tell_what_is_left(const RunFolder& folder, bool begun) {
  const std::string place = folder.path().string(), on = way_on(folder);
  if (!on.empty())
    fmt::print(stderr, "couloir: what was computed is in {}; {}\n", place, on);
  else if (std::filesystem::exists(folder.file("summary.json")) || begun)
    fmt::print(stderr, "couloir: what was computed is in {}; there is no checkpoint to go on from\n", place);
  else
    fmt::print(stderr, "couloir: nothing was computed yet; the log is in {}\n", place);
}

}  // namespace

void OneRun::declare(CLI::App& verb) {
  name = verb.get_name();
  verb.add_option("--threads", threads, "of the solver; any number gives the same bits")->check(CLI::Range(1, 256));
  verb.add_option("--ranks", ranks, "MPI processes that share the continuum; any number gives the same bits")
      ->check(CLI::Range(1, 1024));
  verb.add_flag("--no-report", no_report, "leave out the pictures (couloir report draws them later)");
  verb.add_flag("--json", json, "print the summary alone, machine-readable");
}

Ranks OneRun::ranks_for(const Scene& scene) const {
  if (ranks == 1) return {};
  const Ranks all = Ranks::of_program();
  if (all.count() != ranks) {
    throw SceneError(fmt::format("--ranks {}: the program runs on {} rank{}; start it as ./couloir {}, which calls mpirun", ranks,
                                 all.count(), all.count() == 1 ? "" : "s", name));
  }
  const bool planes =
      std::ranges::any_of(scene.obstacles, [](const auto& o) { return o.method == ObstacleSpec::Method::planes; });
  if (scene.mode != Mode::continuum || scene.continuum.scheme != "central_upwind" || planes) {
    throw SceneError(
        fmt::format("--ranks {}: several ranks share the continuum of scheme central_upwind, without planes, in mode "
                    "continuum; use --threads here{}",
                    ranks, scene.mode == Mode::continuum ? "" : ", and grains.ranks for the engine"));
  }
  return all;
}

int help_run(const OneRun& verb, const Scene& scene, const Ranks& ranks, const std::string& checkpoints) {
  return run_scene(scene, options_for(verb, ranks, checkpoints), {}).status == "done" ? 0 : 3;
}

int run_in(const RunFolder& folder, const OneRun& verb, const Scene& scene, const Ranks& ranks) {
  const std::string work = folder.file("engine"), checkpoints = folder.file("checkpoint");
  std::filesystem::create_directories(work);
  RunOptions options = options_for(verb, ranks, checkpoints);
  options.work_dir = work;
  options.workers = default_worker_folder();
  options.packings = packings_folder();

  ConsoleSettings screen;
  screen.terminal = isatty(fileno(stderr));
  screen.quiet = verb.json;
  RunEnd end;
  Begun begun;
  try {
    Records records(folder.file("records.h5"), write_scene(scene), checkpoints, verb.resume,
                    {options.made_by, verb.threads, verb.ranks});
    Xdmf xdmf(folder.path().string());
    ForcesCsv forces(folder.file("forces.csv"), verb.resume);
    Console console(folder.file("log.txt"), screen, verb.resume);
    Summary summary(folder.file("summary.json"));
    // Records flush a frame before Xdmf names it; the summary is last, so that its being there means that all else is.
    end = run_scene(scene, options, {&begun, &records, &xdmf, &forces, &console, &summary});
  } catch (const SceneError&) {
    throw;  // nothing was touched
  } catch (...) {
    tell_what_is_left(folder, begun.yes);
    throw;
  }  // all files are closed before the report reads them
  if (end.status == "interrupted")
    fmt::print(stderr, "couloir: interrupted; what was computed is in {}; {}\n", folder.path().string(), way_on(folder));
  return end.status == "done" ? 0 : 3;
}

int finish_run(const RunFolder& folder, const OneRun& verb, const Scene& scene, int exit_code) {
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

}  // namespace couloir
