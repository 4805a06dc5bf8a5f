#include "coupling/check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/scene_options.hpp"
#include "app/stop_signal.hpp"
#include "app/verbs.hpp"
#include "coupling/check/check_text.hpp"
#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

struct CheckVerb : CaseOptions {
  std::vector<std::string> experiments, cases;
};

// "Table 5.2" is the table with all its rows, "Table 5.2, 1" one of them.
bool is_named(const CheckCase& c, const std::string& name) {
  return c.name == name || c.name.starts_with(name + ", ");
}

void keep_named(std::vector<Expected>& experiments, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::vector<std::string> known;
  for (const Expected& e : experiments)
    for (const CheckCase& c : e.cases) known.push_back(c.name);
  for (const std::string& name : names)
    if (std::ranges::none_of(experiments, [&](const Expected& e) {
          return std::ranges::any_of(e.cases, [&](const CheckCase& c) { return is_named(c, name); });
        })) {
      const std::string near = nearest_name(name, known);
      throw SceneError(
          fmt::format("--case '{}' is none of what is checked{}", name,
                      near.empty() ? "; a case's name stands before the colon of its lines" : "; did you mean '" + near + "'?"));
    }
  for (Expected& e : experiments)
    std::erase_if(e.cases, [&](const CheckCase& c) {
      return std::ranges::none_of(names, [&](const std::string& name) { return is_named(c, name); });
    });
}

int check(const CheckVerb& verb) {
  std::vector<Expected> expected;
  for (const std::string& file : find_case_files(verb.experiments, "expected.yaml"))
    expected.push_back(read_expected(file, verb.choice()));
  keep_named(expected, verb.cases);
  if (std::ranges::all_of(expected, [](const Expected& e) { return e.cases.empty(); }))
    throw SceneError("there is nothing to check: no case is left; give other experiments, or another --variant");

  CheckSettings settings;
  settings.jobs = jobs_or_cores(verb.jobs);
  RunPool pool(own_program(), verb.runs_folder(), materials_folder(), settings.jobs);
  note_stop_signals();
  settings.stop = told_to_stop;
  pool.stop_when(told_to_stop);
  settings.on_case = [&](const std::vector<Finding>& findings) {
    for (const Finding& f : findings) fmt::print(verb.json ? stderr : stdout, "{}\n", finding_line(f));
    std::fflush(verb.json ? stderr : stdout);
  };
  const std::vector<Finding> findings = check_experiments(expected, pool, materials_folder(), settings);
  if (verb.json)
    fmt::print("{}\n", findings_json(findings).dump(2));
  else
    fmt::print("\n{}", findings_table(findings));
  if (told_to_stop()) {
    fmt::print(stderr, "couloir: interrupted; the runs that were done are in {}, and the same command goes on from them\n",
               verb.runs);
    return 3;
  }
  return std::ranges::any_of(findings, [](const Finding& f) { return f.verdict == Verdict::fail; }) ? 1 : 0;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CheckVerb>();
  CLI::App* verb =
      app.add_subcommand("check", "run experiments and compare them with their expected.yaml; exit code 1 where one fails");
  verb->add_option("EXPERIMENT", options->experiments, "experiments' folders, or a folder of those")->required();
  verb->add_option("--case", options->cases,
                   "only this case, or table, or row of one: 'Table 5.2, 1'; may be given more than once")
      ->take_all()
      ->allow_extra_args(false);
  options->declare(*verb, "the short variants that the cases name; leaves out what has none",
                   "print the findings alone, machine-readable");
  verb->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace couloir
