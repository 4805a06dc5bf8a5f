#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/python_script.hpp"
#include "app/scene_options.hpp"
#include "app/stop_signal.hpp"
#include "app/verbs.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/study/ladder.hpp"
#include "coupling/study/study_table.hpp"
#include "coupling/study/study_text.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;

struct StudyVerb : CaseOptions {
  std::string path, out;
  bool dry_run = false, no_report = false, keep = false;
};

std::string study_file(const std::string& path) {
  const std::vector<std::string> files = find_case_files({path}, "study.yaml");
  if (files.size() > 1)
    throw SceneError(fmt::format("{} holds {} studies, such as {}; give one of them", path, files.size(), files.front()));
  return files.front();
}

// Made where it is missing. A folder with other things in it is not written into.
fs::path study_folder(const StudyVerb& verb, const Study& study) {
  fs::path folder = verb.out;
  if (verb.out.empty()) folder = fs::path("runs") / fmt::format("study-{}{}", study.name, verb.quick ? "-quick" : "");
  std::error_code error;
  if (fs::exists(folder, error) &&
      !(fs::is_directory(folder, error) && (fs::is_empty(folder, error) || fs::exists(folder / "study.csv"))))
    throw SceneError(folder.string() + " is not empty and no folder of a study; choose another --out");
  fs::create_directories(folder, error);
  if (error) throw SceneError(fmt::format("{} cannot be made: {}; choose another --out", folder.string(), error.message()));
  return folder;
}

int dry_run(const StudyVerb& verb, const Study& study, const RunPool& pool, int jobs) {
  std::vector<DryRow> dry;
  for (const StudyRow& row : study.rows) dry.push_back({row.known || (!row.search && pool.done(row.scene, row.set))});
  if (verb.json)
    fmt::print("{}\n", dry_run_json(study, dry).dump(2));
  else
    fmt::print("{}", dry_run_table(study, dry, jobs));
  return 0;
}

// Lines that stay, and on a terminal below them one that is written over.
class Screen {
 public:
  explicit Screen(std::FILE* out) : out_(out), terminal_(isatty(fileno(out)) != 0) {}
  void line(const std::string& text, const std::string& progress) {
    fmt::print(out_, "{}{}{}\n", terminal_ ? "\r\x1b[K" : "", text, terminal_ ? "" : "   [" + progress + "]");
    over(progress);
  }
  void over(const std::string& progress) {
    if (terminal_) fmt::print(out_, "\r\x1b[K{}", progress);
    std::fflush(out_);
  }
  void end() {
    if (terminal_) fmt::print(out_, "\r\x1b[K");
  }

 private:
  std::FILE* out_;
  bool terminal_;
};

// ladder.json in the study's folder and, where it shall be kept, beside study.yaml; a ladder with rungs missing is not kept.
// Returns the one to look at.
std::string keep_ladder(const StudyVerb& verb, const Study& study, const std::vector<StudyResult>& results,
                        const fs::path& folder, bool whole) {
  if (!study.ladder) return "";
  const std::string text = ladder_json(study, results).dump(2) + "\n", own = (folder / "ladder.json").string();
  write_atomically(own, text);
  if (!verb.keep || !whole) return own;
  const std::string kept = (fs::path(study_file(verb.path)).parent_path() / "ladder.json").string();
  write_atomically(kept, text);
  return kept;
}

int study(const StudyVerb& verb) {
  const Study study = read_study(study_file(verb.path), verb.choice(), materials_folder());
  if (verb.keep && !study.ladder) throw SceneError(verb.path + ": --keep keeps a ladder, but this study has none");
  if (verb.keep && verb.quick)
    throw SceneError(verb.path + ": --keep and --quick: the short ladder is none to go by; leave out one");
  const int jobs = jobs_or_cores(verb.jobs);
  RunPool pool(own_program(), verb.dry_run ? verb.runs : verb.runs_folder(), materials_folder(), jobs);
  if (verb.dry_run) return dry_run(verb, study, pool, jobs);
  const fs::path folder = study_folder(verb, study);
  note_stop_signals();
  pool.stop_when(told_to_stop);
  Screen screen(verb.json ? stderr : stdout);
  StudySettings settings;
  settings.jobs = jobs;
  settings.stop = told_to_stop;
  settings.on_row = [&](const auto& row, const auto& result, const auto& p) {
    screen.line(row_line(row, result), progress_line(p));
  };
  settings.tick = [&](const auto& p) { screen.over(progress_line(p)); };
  const std::vector<StudyResult> results = run_study(study, pool, settings);
  screen.end();

  const auto with = [&](StudyResult::Status status) { return std::ranges::count(results, status, &StudyResult::status); };
  const bool whole = with(StudyResult::Status::waiting) == 0, good = with(StudyResult::Status::failed) == 0;
  const std::string status = !whole ? "interrupted" : good ? "done" : "failed";
  const std::string csv = (folder / "study.csv").string(), h5 = (folder / "study.h5").string();
  const std::vector<StudyTableColumn> table = study_table(study, results);
  write_study_h5(h5, study, status, results);
  write_atomically(csv, study_csv(table));
  const std::string ladder = keep_ladder(verb, study, results, folder, whole && good);
  std::string page;
  if (!verb.no_report) {
    run_python(report_script("study.py"), {h5, "--out", folder.string()}, "the study's pictures could not be drawn");
    page = (folder / "index.html").string();
  }
  if (verb.json) {
    const nlohmann::ordered_json out{
        {"study", study.name}, {"status", status},         {"csv", csv}, {"hdf5", h5}, {"report", page},
        {"ladder", ladder},    {"rows", study_json(table)}};
    fmt::print("{}\n", out.dump(2));
  } else {
    if (study.ladder) fmt::print("\n{}", ladder_text(study, results));
    if (!ladder.empty()) fmt::print("ladder: {}\n", ladder);
    fmt::print("\n{}table: {}, {}\n{}", results_table(study, results), csv, h5, page.empty() ? "" : "pictures: " + page + "\n");
  }
  if (!whole) {
    std::fflush(stdout);
    fmt::print(stderr, "couloir: interrupted; {} of {} rows are done and in {}, their runs in {}; the same command goes on\n",
               with(StudyResult::Status::done), results.size(), csv, verb.runs);
    return 3;
  }
  return good ? 0 : 1;
}

}  // namespace

void add_study(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<StudyVerb>();
  CLI::App* verb =
      app.add_subcommand("study", "run what a study.yaml asks for: parameters, searches, seeds; one table and pictures");
  verb->add_option("STUDY", options->path, "an experiment's folder, or a study.yaml")->required();
  options->declare(*verb, "the short variants that its tables name", "print the rows alone, machine-readable");
  verb->add_flag("--dry-run", options->dry_run, "list what would run and what it costs by the plan; runs nothing");
  verb->add_flag("--keep", options->keep,
                 "write the ladder beside study.yaml too, as ladder.json, where couloir advise finds it");
  verb->add_option("--out", options->out, "folder of the table and the pictures; default: runs/study-<experiment>");
  verb->add_flag("--no-report", options->no_report, "leave out the pictures");
  verb->callback([options, &exit_code] { exit_code = study(*options); });
}

}  // namespace couloir
