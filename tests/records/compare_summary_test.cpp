#include "coupling/records/compare_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "coupling/records/reproduction.hpp"
#include "coupling/records/summary_file.hpp"
#include "synthetic_run.hpp"

namespace couloir::testing {
namespace {

using nlohmann::json;

json summary() {
  return {{"status", "done"},
          {"time", {{"simulated", 0.4}, {"wall", 3.0}, {"cpu", 2.0}, {"share_engine", 0.5}}},
          {"mass", {{"initial", 0.6}, {"final", 0.5}, {"relative_error", 1e-16}}},
          {"continuum", {{"steps", 200}, {"cell_updates_per_second", 1e6}, {"min_depth", 0.0}}},
          {"flow", {{"max_speed", 1.5}}},
          {"obstacles",
           {{"wall",
             {{"force_peak", 6.15},
              {"force_final", 1e-9},
              {"first_contact", nullptr},
              {"impulse", 0.2},
              {"impulse_across", 1e-18}}}}},
          {"costs", {{{"part", "engine"}, {"seconds", 1.0}}}},
          {"resumed", json::array()}};
}

std::string difference(const json& first, std::optional<double> tolerance = {}, bool grains = false) {
  return summary_difference(first, summary(), tolerance, grains);
}

TEST(CompareSummary, OneRunHasItsOwnSecondsRatesAndCosts) {
  json other = summary();
  other["time"]["wall"] = 9, other["time"]["cpu"] = 9, other["time"]["share_engine"] = 0.9;
  other["continuum"]["cell_updates_per_second"] = 9, other["costs"][0]["seconds"] = 9;
  other["resumed"].push_back({{"time", 0.1}});
  EXPECT_EQ(difference(other), "");
}

TEST(CompareSummary, TheFirstDifferenceIsNamedAndTheOthersCounted) {
  json other = summary();
  other["obstacles"]["wall"]["force_peak"] = 12.3;
  EXPECT_EQ(difference(other), "obstacles.wall.force_peak 12.3 for 6.15");
  other["obstacles"]["wall"]["first_contact"] = 0.1;
  EXPECT_EQ(difference(other), "obstacles.wall.first_contact 0.1 for null, and 1 more");
  json last_bit = summary();
  last_bit["flow"]["max_speed"] = std::nextafter(1.5, 2);
  EXPECT_EQ(difference(last_bit), "flow.max_speed 1.5000000000000002 for 1.5");
}

TEST(CompareSummary, WhatOnlyOneHasIsADifferenceOfOneBuildAlone) {
  json less = summary(), more = summary();
  less.erase("flow"), more["flow"]["min_speed"] = 1;
  EXPECT_EQ(difference(less), "flow.max_speed is missing");
  EXPECT_EQ(difference(more), "flow.min_speed that it has not");
  EXPECT_EQ(difference(less, 1e-6), "");
  EXPECT_EQ(difference(more, 1e-6), "");
}

TEST(CompareSummary, AToleranceIsAShareOfTheLargestOfItsKind) {
  json other = summary();
  other["obstacles"]["wall"]["force_final"] = 1e-7, other["obstacles"]["wall"]["impulse_across"] = -1e-18;
  other["mass"]["relative_error"] = 2e-16, other["continuum"]["steps"] = 201, other["continuum"]["min_depth"] = -1e-20;
  other["obstacles"]["wall"]["first_contact"] = 0.1;
  EXPECT_EQ(difference(other, 1e-6), "");
  other["obstacles"]["wall"]["force_final"] = 1e-3;
  EXPECT_EQ(difference(other, 1e-6), "obstacles.wall.force_final 0.001 for 1e-09");
}

TEST(CompareSummary, WithGrainsAToleranceJudgesImpulsesAndMasses) {
  json other = summary();
  other["obstacles"]["wall"]["force_peak"] = 12.3, other["flow"]["max_speed"] = 2, other["obstacles"]["wall"]["impulse"] = 0.205;
  EXPECT_EQ(difference(other, 0.05, true), "");
  other["obstacles"]["wall"]["impulse"] = 0.3;
  EXPECT_EQ(difference(other, 0.05, true), "obstacles.wall.impulse 0.3 for 0.2");
  other["mass"]["final"] = 0.4;
  EXPECT_EQ(difference(other, 0.05, true), "mass.final 0.4 for 0.5, and 1 more");
}

TEST(CompareSummary, OneThatCannotBeReadIsNoReproduction) {
  const TemporaryFolder folder;
  record(SyntheticRun(Mode::coupled), folder / "a");
  record(SyntheticRun(Mode::coupled), folder / "b");
  const std::string first = folder / "a/summary.json", second = folder / "b/summary.json";
  const auto compared = [&] {
    Reproduction r = reproduction(RecordsReader(folder / "a/records.h5"), RecordsReader(folder / "b/records.h5"), 0);
    compare_summaries(r, first, second);
    return r;
  };
  EXPECT_EQ(compared().verdict(), Reproduction::Verdict::same_bits);
  for (const std::string text : {"{", "[]", "3", ""}) {
    std::ofstream(first) << text;
    EXPECT_EQ(compared().summary, first + " cannot be read, so that its figures cannot be compared") << text;
    EXPECT_EQ(compared().verdict(), Reproduction::Verdict::differs);
  }
  std::filesystem::remove(first);
  EXPECT_EQ(read_summary(first).fault, "is missing");
  EXPECT_THAT(reproduction_text(compared()),
              ::testing::HasSubstr("summary.json is missing, so that its figures cannot be compared\n"
                                   "NOT reproduced: the record is, but not its summary.json\n"));
}

}  // namespace
}  // namespace couloir::testing
