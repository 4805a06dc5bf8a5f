#include "app/replicates.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <mutex>
#include <vector>

#include "app/scene_options.hpp"
#include "app/stop_signal.hpp"
#include "coupling/cases/packings.hpp"
#include "coupling/cases/run_pool.hpp"
#include "coupling/cases/share_out.hpp"
#include "coupling/records/summary_file.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;

PackingRun packing_run(long seed, const PooledRun& run) {
  return {seed, (fs::path("replicates") / fs::path(run.folder).filename()).string(), run.failure, run.summary};
}

// Empty: damaged.
std::map<long, std::string> named_packings(const nlohmann::json& summary) {
  std::map<long, std::string> out;
  const nlohmann::json all = summary.value("replicates", nlohmann::json());
  if (!all.is_object()) return {};
  const nlohmann::json seeds = all.value("seeds", nlohmann::json()), runs = all.value("runs", nlohmann::json());
  if (!seeds.is_array() || !runs.is_array() || seeds.size() != runs.size()) return {};
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    if (!seeds[k].is_number_integer() || !runs[k].is_string()) return {};
    out[seeds[k].get<long>()] = runs[k].get<std::string>();
  }
  return out;
}

}  // namespace

std::map<long, std::string> packing_folders(const RunFolder& folder, const Scene& scene) {
  const std::string run = folder.path().string(), path = folder.file("summary.json");
  const SummaryFile file = read_summary(path);
  if (!file.fault.empty())
    throw SceneError(fmt::format("{}, which names the runs of the packings, {}; run the scene anew: couloir run {} --out ANOTHER",
                                 path, file.fault, folder.file("scene.yaml")));
  const std::map<long, std::string> named = named_packings(file.content);
  std::map<long, std::string> out;
  for (long k = 0; k < scene.grains.replicates; ++k) {
    const long seed = scene.grains.seed + k;
    const auto at = named.find(seed);
    if (at == named.end())
      throw SceneError(
          fmt::format("{}: its replicates name no run of seed {}; couloir resume {} runs what is missing", path, seed, run));
    out[seed] = folder.file(at->second);
    if (!fs::exists(fs::path(out[seed]) / "records.h5"))
      throw SceneError(fmt::format("{}: the run of seed {}, {}, is not there; couloir resume {} runs what is missing", path, seed,
                                   out[seed], run));
  }
  return out;
}

int run_replicates(const RunFolder& folder, const Scene& scene, bool quiet) {
  const std::string file = folder.file("summary.json");
  nlohmann::json summary = nlohmann::json::parse(read_text(file));
  const int jobs = jobs_or_cores(0);
  RunPool pool(own_program(), folder.file("replicates"), materials_folder(), jobs);
  pool.stop_when(told_to_stop);

  const int count = scene.grains.replicates;
  std::vector<PackingRun> runs(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < runs.size(); ++k)
    runs[k] = {scene.grains.seed + static_cast<long>(k), "", "it was not run: the user stopped", {}};
  runs[0] = {scene.grains.seed, ".", "", summary};
  std::mutex screen;
  int done = 1;
  const auto work = [&](std::size_t k) {
    PackingRun& run = runs[k + 1];
    const std::string seed = std::to_string(run.seed);
    try {
      run = packing_run(run.seed, pool.run(folder.file("scene.yaml"), {{"grains.seed", seed}, {"grains.replicates", "1"}}));
    } catch (const Stopped&) {
      return;  // what it says is there already
    }
    const std::scoped_lock lock(screen);
    if (!run.failure.empty())
      fmt::print(stderr, "couloir: the packing of seed {} failed: {}\n", seed, run.failure);
    else if (!quiet)
      fmt::print(stderr, "packing of seed {} done, {} of {}\n", seed, ++done, count);
  };
  share_out(runs.size() - 1, jobs, work, told_to_stop);

  summary["replicates"] = over_packings(runs);
  write_atomically(file, summary.dump(2) + "\n");
  const bool all = summary["replicates"]["failed"].empty();
  if (!all)
    fmt::print(stderr, "couloir: {} of {} packings are done; mean and scatter are of those, in {}; couloir resume {} goes on\n",
               summary["replicates"]["count"].get<int>(), count, file, folder.path().string());
  return all ? 0 : 3;
}

std::string replicates_text(const nlohmann::json& replicates) {
  std::string out;
  if (replicates.at("count").get<int>() < 2) return out;
  const auto of = [](const nlohmann::json& f, const char* unit) {
    const bool one = f.at("scatter").is_null();
    return one ? fmt::format("{:.4g} {}", f.at("mean").get<double>(), unit)
               : fmt::format("{:.4g} +- {:.2g} {}", f.at("mean").get<double>(), f.at("scatter").get<double>(), unit);
  };
  for (const auto& [name, o] : replicates.at("obstacles").items()) {
    if (!o.contains("force_peak") || !o.contains("impulse")) continue;
    out += fmt::format("{}, {} packings: peak {}, impulse {}\n", name, replicates.at("count").get<int>(),
                       of(o.at("force_peak"), "N"), of(o.at("impulse"), "N s"));
  }
  return out;
}

}  // namespace couloir
