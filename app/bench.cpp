// The rates of this machine: runs bench/flow_rate.cpp, which lies beside this program, and prints what it measured as a table.

#include <fmt/format.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "app/verbs.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

using Json = nlohmann::json;

std::string output_of(const std::filesystem::path& program) {
  FILE* pipe = popen(("'" + program.string() + "' --benchmark_format=json 2>/dev/null").c_str(), "r");
  if (!pipe) throw std::runtime_error(program.string() + " could not be started");
  std::string text;
  char part[4096];
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
  const int status = pclose(pipe);
  if (status != 0) throw std::runtime_error(fmt::format("{} ended with {}", program.string(), WEXITSTATUS(status)));
  return text;
}

// {instruction_set, cases: [{group, name, best, mean, bytes_per_cell, stepped_per_wet}]}
Json measured() {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "flow_rate";
  if (!std::filesystem::exists(program)) {
    throw SceneError(
        "this build has no program to measure with: use ./couloir bench, which installs Google Benchmark "
        "(libbenchmark-dev) and builds it, or build the target flow_rate");
  }
  const Json all = Json::parse(output_of(program));
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

}  // namespace

void add_bench(CLI::App& app, int&) {
  auto json = std::make_shared<bool>(false);
  CLI::App* verb = app.add_subcommand("bench", "how fast the continuum is on this machine; about half a minute");
  verb->add_flag("--json", *json, "machine-readable");
  verb->callback([json] {
    const Json found = measured();
    *json ? fmt::print("{}\n", found.dump(2)) : print(found);
  });
}

}  // namespace couloir
