// The rates of this machine: runs bench/flow_rate.cpp, which lies beside this program, and prints what it measured as a table.
// With a scene: what a whole run of it makes of them.

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/scene_options.hpp"
#include "app/verbs.hpp"
#include "coupling/cases/for_shell.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

using Json = nlohmann::json;

std::string output_of(const std::filesystem::path& program, const std::vector<std::string>& words) {
  std::string command = for_shell(program.string());
  for (const std::string& word : words) command += " " + for_shell(word);
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (!pipe) throw std::runtime_error(program.string() + " could not be started");
  std::string text;
  char part[4096];
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
  const int status = pclose(pipe);
  if (status != 0) throw std::runtime_error(fmt::format("{} ended with {}", program.string(), WEXITSTATUS(status)));
  return text;
}

// {instruction_set, cases: [{group, name, best, mean, bytes_per_cell, stepped_per_wet}]}; filter: a regular expression, empty:
// all.
Json measured(const std::string& filter) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "flow_rate";
  if (!std::filesystem::exists(program)) {
    throw SceneError(
        "this build has no program to measure with: use ./couloir bench, which installs Google Benchmark "
        "(libbenchmark-dev) and builds it, or build the target flow_rate");
  }
  std::vector<std::string> words{"--benchmark_format=json"};
  if (!filter.empty()) words.push_back("--benchmark_filter=" + filter);
  const Json all = Json::parse(output_of(program, words));
  Json out{{"instruction_set", all.at("context").at("instruction_set")}, {"cases", Json::array()}};
  for (const Json& b : all.at("benchmarks")) {
    const std::string name = b.at("name");
    const auto slash = name.find('/'), end = name.find('/', slash + 1);
    Json one{{"group", name.substr(0, slash)},
             {"name", name.substr(slash + 1, end - slash - 1)},
             {"best", b.at("best")},
             {"mean", b.at("rate")}};
    for (const char* key : {"bytes_per_cell", "stepped_per_wet"}) {
      if (b.contains(key)) one[key] = b[key];
    }
    out["cases"].push_back(one);
  }
  return out;
}

void print(const Json& measured) {
  fmt::print("instructions {}; millions of cell updates (cells times stages) a second, best and mean\n",
             measured["instruction_set"].get<std::string>());
  std::string group;
  for (const Json& c : measured["cases"]) {
    if (c["group"] != group) fmt::print("\n{}\n", group = c["group"].get<std::string>());
    const bool stream = group == "stream";
    fmt::print("  {:<20} {:8.1f} {:8.1f}{}", c["name"].get<std::string>(), c["best"].get<double>() * (stream ? 1e-9 : 1e-6),
               c["mean"].get<double>() * (stream ? 1e-9 : 1e-6), stream ? " GB/s" : "");
    if (c.contains("bytes_per_cell")) fmt::print("   {:6.1f} bytes a cell", c["bytes_per_cell"].get<double>());
    if (c.contains("stepped_per_wet") && c["stepped_per_wet"] > 1) {
      fmt::print("   {:.2f} cells stepped for each wet one", c["stepped_per_wet"].get<double>());
    }
    fmt::print("\n");
  }
}

// A folder that is gone when this is.
struct Scrap {
  std::filesystem::path path = std::filesystem::temp_directory_path() / ("couloir_bench_" + std::to_string(getpid()));
  ~Scrap() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

// Cell updates (cells times stages) a second of processor time, the best of some rounds, in each of which all are measured once:
// {run: all that couloir run does, stepping: the solver's steps in it, solver: of flow_rate, without effects, kernel: the bare
// one}.
Json run_rates(const SceneOptions& options, int rounds) {
  const Scene scene = options.read();
  if (scene.mode != Mode::continuum) throw SceneError("bench compares the continuum's rate: give it --mode continuum");
  const Scrap scrap;
  std::vector<std::string> words{"run", options.path, "--json", "--no-report", "--out", scrap.path.string()};
  for (const auto& [key, value] : options.overrides()) words.insert(words.end(), {"--set", key + "=" + value});
  Json out{{"run", 0.0}, {"stepping", 0.0}, {"solver", 0.0}, {"kernel", 0.0}};
  const auto better = [&](const char* name, double rate) { out[name] = std::max(out[name].get<double>(), rate); };
  for (int round = 0; round < rounds; ++round) {
    const Json alone = measured("effect/(none|bare_kernel)/");
    for (const Json& c : alone["cases"]) better(c["name"] == "none" ? "solver" : "kernel", c["mean"]);
    out["instruction_set"] = alone["instruction_set"];
    std::filesystem::remove_all(scrap.path);
    const Json run = Json::parse(output_of(own_program(), words));
    const double updates = run["continuum"]["cell_updates"];
    double set_up = 0;
    for (const Json& c : run["costs"]) set_up += c["part"] == "set_up" ? c["seconds"].get<double>() : 0;
    better("run", updates / (run["time"]["cpu"].get<double>() - set_up));
    better("stepping", updates / run["time"]["cpu_continuum"].get<double>());
  }
  return out;
}

void print_run(const Json& rates) {
  const auto line = [&](const char* name, const char* what) {
    const double rate = rates[name], solver = rates["solver"], kernel = rates["kernel"];
    fmt::print("  {:<48} {:7.1f} {:8.2f} {:8.2f}\n", what, rate * 1e-6, rate / solver, rate / kernel);
  };
  fmt::print("instructions {}; millions of cell updates (cells times stages) a second, best of the rounds\n",
             rates["instruction_set"].get<std::string>());
  fmt::print("  {:<48} {:>7} {:>8} {:>8}\n", "", "rate", "/solver", "/kernel");
  line("run", "couloir run, after its set-up");
  line("stepping", "of it the solver's steps");
  line("solver", "solver alone, no effects, 256 x 128 cells");
  line("kernel", "bare kernel, likewise");
}

}  // namespace

void add_bench(CLI::App& app, int&) {
  struct Options {
    SceneOptions scene;
    int rounds = 5;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("bench", "how fast the continuum is on this machine; about half a minute");
  options->scene.declare(*verb);
  verb->get_option("SCENE")->required(false)->description("its run against solver and kernel alone; none: all rates");
  verb->add_option("--rounds", options->rounds, "with a SCENE: how often all are measured")->check(CLI::Range(1, 100));
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options] {
    const bool run = !options->scene.path.empty();
    const Json found = run ? run_rates(options->scene, options->rounds) : measured("");
    if (options->json) return fmt::print("{}\n", found.dump(2));
    run ? print_run(found) : print(found);
  });
}

}  // namespace couloir
