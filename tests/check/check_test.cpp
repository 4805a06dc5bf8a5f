// Whole checks, through the program: exit codes, lines, and runs that are used again.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "check_folder.hpp"

namespace couloir {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

struct Output {
  int code = -1;
  std::string text;
};

Output check(const CheckFolder& folder, const std::string& words, const std::string& before = "") {
  const std::string command =
      fmt::format("exec 2>&1; cd '{}' && {} '{}/bin/couloir' check {}", folder / "", before, COULOIR_BINARY_DIR, words);
  Output out;
  std::FILE* pipe = popen(command.c_str(), "r");
  for (char buffer[4096]; const std::size_t n = std::fread(buffer, 1, sizeof(buffer), pipe);) out.text.append(buffer, n);
  out.code = WEXITSTATUS(pclose(pipe));
  return out;
}

bool is_part(const std::filesystem::directory_entry& entry) {
  return entry.path().filename().string().find(".part-") != std::string::npos;
}

// g (sin 30 - tan 20 cos 30) 0.1 s = 0.18129 m/s in the slab's middle.
std::string expected(double speed, const std::string& more = "") {
  return fmt::format(R"(cases:
  - name: slab
    set: {{continuum.cfl: 0.4}}
    expect:
      - {{quantity: mass.initial, value: 400 g, tolerance: 0.01 %, evidence: exact, source: geometry}}
      - {{quantity: gauges.middle.max_speed, value: {} m/s, tolerance: 0.5 %, evidence: exact, source: u = m t}}
{})",
                     speed, more);
}

TEST(Check, PassesFailsAndUsesRunsAgain) {
  const CheckFolder folder("check");
  folder.write("slab/expected.yaml", expected(0.18129));
  const Output first = check(folder, "slab");
  EXPECT_EQ(first.code, 0) << first.text;
  EXPECT_THAT(first.text, HasSubstr("pass    slab, slab: mass.initial = 400 g, expected 400 g"));
  EXPECT_THAT(first.text, HasSubstr("2 passed, 0 failed, 0 shown only, 0 skipped"));

  const auto runs = [&] {
    std::vector<std::pair<std::string, std::filesystem::file_time_type>> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "runs/check"))
      out.emplace_back(entry.path().string(), std::filesystem::last_write_time(entry.path() / "summary.json"));
    return out;
  };
  const auto before = runs();
  ASSERT_EQ(before.size(), 1u) << "one run, and nothing left beside it";
  folder.write("slab/expected.yaml", expected(0.2));
  const Output wrong = check(folder, "slab");
  EXPECT_EQ(wrong.code, 1) << wrong.text;
  EXPECT_THAT(wrong.text, HasSubstr("FAIL    slab, slab: gauges.middle.max_speed"));
  EXPECT_THAT(wrong.text, HasSubstr("1 passed, 1 failed"));
  EXPECT_EQ(runs(), before) << "the run is used again";

  const Output none = check(folder, "slab --case slap");
  EXPECT_EQ(none.code, 2) << none.text;
  EXPECT_THAT(none.text, HasSubstr("--case 'slap' is none of what is checked; did you mean 'slab'?"));

  const auto json = nlohmann::json::parse(check(folder, "slab --json 2>/dev/null").text);
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[1]["verdict"], "fail");
  EXPECT_NEAR(json[1]["value"].get<double>(), 0.18129, 1e-3);
  EXPECT_THAT(json[1]["command"].get<std::string>(), HasSubstr("--set continuum.cfl=0.4"));
}

TEST(Check, SearchesForACriticalValue) {
  const CheckFolder folder("check_search");
  // The speed falls as the friction rises: g (sin 30 - tan d cos 30) 0.1 s < 0.1 m/s from d = 24.78 deg on.
  folder.write("slab/expected.yaml", R"(cases:
  - name: angle
    search: {key: material.basal_friction_angle, from: 20 deg, to: 28 deg, step: 0.5 deg, quantity: gauges.middle.max_speed, bound: 0.1 m/s}
    expect:
      - {quantity: critical, value: 25, tolerance: 0.1, evidence: exact, source: u = m t}
)");
  const Output out = check(folder, "slab --jobs 2");
  EXPECT_EQ(out.code, 0) << out.text;
}

TEST(Check, ASearchThatFindsNothingSaysWhatItSaw) {
  const CheckFolder folder("check_no_search");
  // The speed rises with the slope: g (sin a - tan 20 cos a) 0.1 s, 0.089 m/s at 25 deg and 0.181 m/s at 30 deg.
  const std::string search = R"(cases:
  - name: angle
    search: {key: terrain.angle, from: 25 deg, to: 30 deg, step: 1 deg, quantity: gauges.middle.max_speed, bound: BOUND}
    expect:
      - {quantity: critical, value: 25, tolerance: 0.1, evidence: exact, source: u = m t}
)";
  const auto with = [&](const std::string& bound) {
    std::string text = search;
    folder.write("slab/expected.yaml", text.replace(text.find("BOUND"), 5, bound));
    return check(folder, "slab --jobs 2");
  };
  const Output rises = with("0.1 m/s");
  EXPECT_EQ(rises.code, 1) << rises.text;
  EXPECT_THAT(rises.text,
              MatchesRegex("(.|\n)*gauges.middle.max_speed is 0.0[89][0-9]* m/s at 25 deg and 0.18[0-9]* m/s at 30 deg "
                           "of terrain.angle: only the upper end misses its bound of 0.1 m/s(.|\n)*"));
  EXPECT_THAT(with("0.05 m/s").text, HasSubstr("both ends miss its bound of 0.05 m/s"));
}

TEST(Check, RefusesWrongInputBeforeAnyRun) {
  const CheckFolder folder("check_wrong");
  folder.write("slab/expected.yaml", expected(0.18129,
                                              "  - name: other\n    set: {continuum.cll: 5 mm}\n    expect:\n"
                                              "      - {quantity: mass.initial, value: 1 kg, tolerance: 1 %, "
                                              "evidence: exact, source: none}\n"));
  const Output out = check(folder, ".");
  EXPECT_EQ(out.code, 2);
  EXPECT_THAT(out.text, HasSubstr("expected.yaml:7: other: --set continuum.cll: continuum.cll is unknown; did you mean 'cell'?"));
  EXPECT_FALSE(std::filesystem::exists(folder / "runs/check") && !std::filesystem::is_empty(folder / "runs/check"));

  folder.write("slab/expected.yaml", "cases:\n  - name: slab\n    exspect: []\n");
  const Output unknown = check(folder, "slab");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.text, HasSubstr("slab/expected.yaml:3: exspect is unknown; did you mean 'expect'?"));
  EXPECT_EQ(check(folder, "nowhere").code, 2);

  folder.write("slab/expected.yaml",
               "cases:\n  - name: slab\n    expect: [{quantity: mass.initail, value: 1 kg, tolerance: 1 %, "
               "evidence: exact, source: s}]\n");
  const Output path = check(folder, "slab");
  EXPECT_EQ(path.code, 2);
  EXPECT_THAT(path.text, HasSubstr("did you mean 'initial'?"));
}

TEST(Check, ARunThatFailsIsAFailedCheck) {
  const CheckFolder folder("check_failed");
  folder.write("slab/expected.yaml", expected(0.18129));
  const Output out = check(folder, "slab", "ulimit -f 0; ");  // no file may hold a byte
  EXPECT_EQ(out.code, 1) << out.text;
  EXPECT_THAT(out.text, HasSubstr("FAIL    slab, slab: mass.initial = -"));
  EXPECT_THAT(out.text, HasSubstr("the run "));
}

TEST(Check, InterruptedItKeepsWhatIsDoneAndGoesOn) {
  const CheckFolder folder("check_interrupted");
  std::string cases = "cases:\n";
  for (const int angle : {26, 28, 30, 32})
    cases += fmt::format(
        "  - {{name: at {0}, set: {{terrain.angle: {0} deg, continuum.cell: 1.25 mm}}, expect: [{{quantity: mass.initial, "
        "value: 400 g, tolerance: 1 %, evidence: exact, source: geometry}}]}}\n",
        angle);
  folder.write("slab/expected.yaml", cases);
  // Each case takes about a second; the signal comes when the first is done.
  const Output out = check(folder,
                           "slab --jobs 1 & pid=$!; n=0; until ls -d runs/check/slab-*/summary.json | grep -v part; do "
                           "sleep 0.02; n=$((n+1)); [ $n -lt 3000 ] || break; done; kill -INT $pid; wait $pid",
                           "true; ");  // else the folder is left at once
  EXPECT_EQ(out.code, 3) << out.text;
  EXPECT_THAT(out.text, HasSubstr("interrupted; the runs that were done are in runs/check, and the same command goes on"));
  std::ptrdiff_t whole = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "runs/check")) {
    if (is_part(entry)) {  // of the run that was under way: kept where it can be gone on with
      EXPECT_TRUE(entry.path().extension() == ".log" || std::filesystem::exists(entry.path() / "checkpoint")) << entry.path();
      continue;
    }
    EXPECT_TRUE(std::filesystem::exists(entry.path() / "summary.json")) << "half done: " << entry.path();
    ++whole;
  }
  EXPECT_GE(whole, 1);
  EXPECT_LT(whole, 4);
  const Output again = check(folder, "slab");
  EXPECT_EQ(again.code, 0) << again.text;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "runs/check"))
    EXPECT_FALSE(is_part(entry)) << "left behind: " << entry.path();
}

}  // namespace
}  // namespace couloir
