#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/one_run.hpp"
#include "app/replicates.hpp"
#include "app/scene_options.hpp"
#include "app/verbs.hpp"
#include "coupling/plan/limits.hpp"
#include "coupling/records/provenance.hpp"
#include "coupling/records/record_error.hpp"
#include "coupling/records/records.hpp"
#include "coupling/records/reproduction.hpp"
#include "coupling/scene/reader.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;

struct ReproduceVerb : OneRun {
  std::string run, out, with, tolerance;
};

// What a record lacks is wrong input here.
template <class Read>
auto told_as_input(const RunFolder& folder, const Read& read) {
  try {
    return read();
  } catch (const RecordError& error) {
    throw SceneError(fmt::format("{}: its record cannot be read: {}; take a whole copy of it, or run the scene anew",
                                 folder.path().string(), error.what()));
  }
}

// A run's record, whole and of this layout. Throws SceneError: a record that cannot be compared is wrong input.
RecordsReader whole_record(const RunFolder& folder) {
  const std::string run = folder.path().string();
  return told_as_input(folder, [&] {
    RecordsReader record(folder.file("records.h5"));
    for (const char* attribute : {"scene", "mode", "git_revision"}) record.text(attribute);
    const double version = record.has("format_version") ? record.number("format_version") : 0;
    if (version != Records::kFormatVersion)
      throw SceneError(
          fmt::format("{}: its record is of layout {:.0f}, this program reads {}; take the revision that made it: {}", run,
                      version, Records::kFormatVersion, record.text("git_revision")));
    if (const std::string status = record.text("status"); status != "done")
      throw SceneError(
          fmt::format("{}: this run is not done, its record says {}: there is nothing whole to compare with; couloir "
                      "resume {} goes on with it",
                      run, status, run));
    return record;
  });
}

// The groups that a run of this scene has; older revisions wrote fewer.
std::vector<std::string> groups_of(const RecordsReader& record, const Scene& scene) {
  std::vector<std::string> out;
  for (const ObstacleSpec& o : scene.obstacles) out.push_back("forces/" + o.name);
  for (const GaugeSpec& g : scene.record.gauges) out.push_back("gauges/" + g.name);
  for (std::size_t k = 0; k < record.frames().size(); ++k) out.push_back(fmt::format("frames/{:06d}", k));
  if (record.text("git_revision") == provenance().revision) out.insert(out.end(), {"gauges", "measures", "stresses"});
  return out;
}

// That all which compare() reads is there: told before hours of work, not after.
void require_readable(const RunFolder& folder, const Scene& scene) {
  const RecordsReader record = whole_record(folder);
  told_as_input(folder, [&] {
    for (const std::string& group : groups_of(record, scene))
      if (!record.holds(group))
        throw RecordError(fmt::format("{} is damaged: it has no group {}", folder.file("records.h5"), group));
    first_difference(record, record);
  });
}

Scene scene_of(const RecordsReader& record, const std::string& run) {
  try {
    return read_scene_text(record.text("scene"), (fs::path(run) / "scene.yaml").string(), materials_folder());
  } catch (const SceneError& error) {
    throw SceneError(fmt::format("{}: the scene in its record is none for this program ({}); take the revision that made it: {}",
                                 run, error.what(), record.text("git_revision")));
  }
}

// RUN-again beside it, with -2, -3, ... where that is taken.
std::string free_beside(const std::string& run) {
  fs::path path = fs::path(run).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const std::string base = path.string() + "-again";
  std::string name = base;
  for (int k = 2; fs::exists(fs::symlink_status(name)); ++k) name = fmt::format("{}-{}", base, k);
  return name;
}

double tolerance_of(const ReproduceVerb& verb, bool grains) {
  return verb.tolerance.empty() ? default_tolerance(grains) : share_of("--tolerance", verb.tolerance, "1e-6 or 2 %");
}

struct PackingFolders {
  std::string name, first, second;
};

// The runs of both folders, packing by packing, by their seeds.
std::vector<PackingFolders> packings_of(const RunFolder& first, const RunFolder& second, const Scene& scene) {
  if (scene.grains.replicates < 2 || scene.mode == Mode::continuum) return {{"", first.path().string(), second.path().string()}};
  std::vector<PackingFolders> out;
  const auto others = packing_folders(second, scene);
  for (const auto& [seed, folder] : packing_folders(first, scene))
    out.push_back({fmt::format("seed {}", seed), folder, others.at(seed)});
  return out;
}

// Of the other folder, that it is of the same scene.
void require_scene(const RunFolder& other, const std::string& scene, const std::string& run) {
  if (whole_record(other).text("scene") != scene)
    throw SceneError(fmt::format("{} is a run of another scene than {}; couloir report {} {} shows them side by side",
                                 other.path().string(), run, other.path().string(), run));
}

// The second run; an exit code of its own where it does not come to its end.
int run_again(const RunFolder& again, const ReproduceVerb& verb, const Scene& scene, const Ranks& ranks) {
  const int code = run_in(again, verb, scene, ranks);
  if (code != 0 || scene.grains.replicates < 2 || scene.mode == Mode::continuum) return code;
  return run_replicates(again, scene, verb.json);
}

int compare(const RunFolder& first, const RunFolder& second, const ReproduceVerb& verb, const Scene& scene, bool ours) {
  const bool grains = scene.mode != Mode::continuum;
  const double tolerance = tolerance_of(verb, grains);
  bool good = true;
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  std::string text;
  for (const PackingFolders& p : packings_of(first, second, scene)) {
    Reproduction r = reproduction(whole_record(RunFolder::open(p.first)), whole_record(RunFolder::open(p.second)), tolerance);
    compare_summaries(r, RunFolder::open(p.first).file("summary.json"), RunFolder::open(p.second).file("summary.json"));
    r.name = p.name;
    good = good && r.verdict() != Reproduction::Verdict::differs;
    runs.push_back(reproduction_json(r));
    text += reproduction_text(r);
  }
  const bool kept = !ours || !good;
  if (!kept) fs::remove_all(second.path());
  const std::string where = kept ? second.path().string() : "";
  if (verb.json)
    fmt::print(
        "{}\n",
        nlohmann::ordered_json{{"run", first.path().string()}, {"again", where}, {"reproduced", good}, {"runs", runs}}.dump(2));
  else
    fmt::print("{}{}", text,
               kept ? fmt::format("the second run: {}\n", where) : "the second run was removed (--out DIR keeps it)\n");
  return good ? 0 : 1;
}

int reproduce(const ReproduceVerb& verb) {
  const RunFolder first = RunFolder::open(verb.run);
  const RecordsReader record = whole_record(first);
  const std::string text = record.text("scene");
  const Scene scene = scene_of(record, verb.run);
  tolerance_of(verb, scene.mode != Mode::continuum);  // a slip of the pen is told before hours of work
  if (!verb.with.empty()) {
    const RunFolder other = RunFolder::open(verb.with);
    require_scene(other, text, verb.run);
    for (const PackingFolders& p : packings_of(first, other, scene))
      for (const std::string& folder : {p.first, p.second}) require_readable(RunFolder::open(folder), scene);
    return compare(first, other, verb, scene, false);
  }
  for (const PackingFolders& p : packings_of(first, first, scene)) require_readable(RunFolder::open(p.first), scene);
  const Ranks ranks = verb.ranks_for(scene);
  check_memory(scene, make_plan(scene), verb.ranks);
  if (!ranks.first()) return help_run(verb, scene, ranks, "checkpoint");
  const RunFolder again = RunFolder::create(scene, verb.out.empty() ? free_beside(verb.run) : verb.out, text);
  if (const int code = run_again(again, verb, scene, ranks); code != 0) {
    fmt::print(stderr, "couloir: after couloir resume {0}, couloir reproduce {1} --with {0} compares the two\n",
               again.path().string(), verb.run);
    return code;
  }
  return compare(first, again, verb, scene, verb.out.empty());
}

}  // namespace

void add_reproduce(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReproduceVerb>();
  CLI::App* verb = app.add_subcommand("reproduce", "run again from a run's own record, and compare: bit for bit, or by how much");
  verb->add_option("RUN", options->run, "the run's folder")->required();
  CLI::Option* out =
      verb->add_option("--out", options->out, "folder of the second run; default: RUN-again, removed where it is the same");
  verb->add_option("--with", options->with, "compare with this run instead of running again")->excludes(out);
  verb->add_option(
      "--tolerance", options->tolerance,
      "where the machine or the build is another one: share of each quantity's largest value; default: 1e-6, with grains 5 %");
  options->declare(*verb);
  verb->remove_option(verb->get_option("--no-report"));
  verb->callback([options, &exit_code] { exit_code = reproduce(*options); });
}

}  // namespace couloir
