#include "coupling/check/verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "coupling/cases/search.hpp"
#include "coupling/cases/summary_value.hpp"
#include "coupling/check/check_text.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

using ::testing::HasSubstr;

Finding finding(double expected, Tolerance tolerance, double si_of_unit = 1) {
  Finding f;
  f.expectation.value = expected;
  f.expectation.tolerance = tolerance;
  f.expectation.unit.si = si_of_unit;
  return f;
}

Verdict verdict(double expected, Tolerance tolerance, double value) {
  Finding f = finding(expected, tolerance);
  judge(f, value);
  return f.verdict;
}

TEST(Verdict, JudgesByItsTolerance) {
  const Tolerance relative{Tolerance::Kind::relative, 0.01}, absolute{Tolerance::Kind::absolute, 0.5}, none{};
  EXPECT_EQ(verdict(100, relative, 100.99), Verdict::pass);
  EXPECT_EQ(verdict(100, relative, 101.01), Verdict::fail);
  EXPECT_EQ(verdict(-100, relative, -100.99), Verdict::pass);
  EXPECT_EQ(verdict(-100, relative, 100), Verdict::fail);
  EXPECT_EQ(verdict(100, absolute, 99.51), Verdict::pass);
  EXPECT_EQ(verdict(100, absolute, 99.49), Verdict::fail);
  EXPECT_EQ(verdict(100, none, 1e9), Verdict::shown);
  EXPECT_EQ(verdict(100, relative, std::nan("")), Verdict::fail);
  EXPECT_EQ(verdict(0, absolute, std::nan("")), Verdict::fail);
}

TEST(Verdict, ComparesInTheExpectedUnit) {
  Finding f = finding(2, {Tolerance::Kind::relative, 0.1}, 0.03333);
  judge(f, 0.07);
  EXPECT_NEAR(f.value, 0.07 / 0.03333, 1e-12);
  EXPECT_NEAR(f.deviation, f.value / 2 - 1, 1e-12);
  EXPECT_EQ(f.verdict, Verdict::pass);
}

TEST(Verdict, FindsNumbersAndRatios) {
  const auto summary = nlohmann::json::parse(
      R"({"obstacles": {"wall": {"impulse": 6.0, "first_contact": null}}, "time": {"simulated": 1.5}, "status": "done"})");
  EXPECT_EQ(summary_value(summary, "obstacles.wall.impulse", "p"), 6);
  EXPECT_EQ(summary_value(summary, "obstacles.wall.impulse / time.simulated", "p"), 4);
  EXPECT_TRUE(std::isnan(summary_value(summary, "obstacles.wall.first_contact", "p")));
  const auto error = [&](const std::string& path) -> std::string {
    try {
      summary_value(summary, path, "expected.yaml:7");
    } catch (const SceneError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(error("obstacles.wal.impulse"), HasSubstr("expected.yaml:7: the quantity obstacles.wal.impulse"));
  EXPECT_THAT(error("obstacles.wal.impulse"), HasSubstr("did you mean 'wall'?"));
  EXPECT_THAT(error("status"), HasSubstr("is no number"));
}

// A line for each case, a ratio of long names over two rows, what was skipped as a number.
TEST(FindingsTable, IsLegible) {
  std::vector<Finding> all(4, finding(2, {Tolerance::Kind::relative, 0.1}));
  for (Finding& f : all) f.experiment = "slab", f.name = "long", f.expectation.evidence = "exact";
  all[0].expectation.quantity = "mass.final";
  all[1].expectation.quantity = "obstacles.wall.control_volume.impulse / obstacles.wall.impulse";
  judge(all[0], 2.1), judge(all[1], 3);
  all[2].name = all[3].name = "skipped one";
  EXPECT_EQ(findings_table(all),
            "verdict  quantity                                 value  expected  deviation  allowed  evidence\n"
            "slab: long\n"
            "pass       mass.final                               2.1         2    +5.00 %     10 %  exact\n"
            "FAIL       obstacles.wall.control_volume.impulse      3         2   +50.00 %     10 %  exact\n"
            "            / obstacles.wall.impulse\n"
            "skipped by --quick: slab 2\n"
            "1 passed, 1 failed, 0 shown only, 2 skipped\n");
}

TEST(Search, FindsTheSmallestGoodValueWithFewTrials) {
  Search search;
  search.from = 0.5, search.to = 6, search.step = 0.1;
  int trials = 0;
  const auto good_from = [&](double least) {
    return [&trials, least](double v) {
      ++trials;
      return v >= least - 1e-9;
    };
  };
  EXPECT_NEAR(smallest_good(search, good_from(4.4)), 4.4, 1e-12);
  EXPECT_LE(trials, 8);
  EXPECT_NEAR(smallest_good(search, good_from(0.1)), 0.5, 1e-12);
  EXPECT_NEAR(smallest_good(search, good_from(6)), 6, 1e-12);
  EXPECT_TRUE(std::isnan(smallest_good(search, good_from(7))));
}

// The critical value may lie below what was tried.
TEST(Search, SaysThatItsLowestValueIsGoodAlready) {
  Search search;
  search.key = "obstacles.wall.height", search.unit = "mm", search.from = 60, search.to = 80, search.step = 5;
  const auto found = [&](double critical) {
    return search_critical(
        search, [&](double at) { return at >= critical ? 0.0 : 1.0; }, [] { return std::string(); });
  };
  EXPECT_EQ(found(65).critical, 65);
  EXPECT_EQ(found(65).remark, "");
  EXPECT_EQ(found(55).critical, 60);
  EXPECT_EQ(found(55).remark, "60 mm is good already, the lowest that the search tries: the critical value may be less");
}

// What was seen, in the units of the file: a quantity that rises is another mistake than a bracket that is too low.
TEST(Search, SaysWhatItSawWhereNoValueIsGood) {
  Search search;
  search.key = "terrain.angle", search.unit = "deg", search.quantity = "flow.max_speed";
  search.from = 20, search.to = 28.3, search.step = 0.5;
  search.bound = 200, search.bound_unit = {"mm/s", "a velocity", 1e-3};
  EXPECT_EQ(
      why_none_is_good(search, 0.15, 0.35),
      "flow.max_speed is 150 mm/s at 20 deg and 350 mm/s at 28 deg of terrain.angle: only the upper end misses its bound of "
      "200 mm/s, but a search needs a quantity that falls as the key rises");
  EXPECT_EQ(why_none_is_good(search, 0.35, 0.25),
            "flow.max_speed is 350 mm/s at 20 deg and 250 mm/s at 28 deg of terrain.angle: both ends miss its bound of 200 mm/s; "
            "search elsewhere");
  EXPECT_THAT(why_none_is_good(search, 0.35, std::nan("")), HasSubstr("null at 28 deg of terrain.angle: both ends miss"));
}

}  // namespace
}  // namespace couloir
