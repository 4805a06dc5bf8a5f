#include "coupling/records/reproduction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "synthetic_run.hpp"

namespace couloir::testing {
namespace {

using Verdict = Reproduction::Verdict;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Reproduced : ::testing::Test {
  TemporaryFolder folder;
  RecordsReader recorded(const std::string& name, Mode mode, double scale, const Started& started) const {
    record(SyntheticRun(mode, scale), folder / name, started);
    return RecordsReader(folder / (name + "/records.h5"));
  }
};

const QuantityDifference& quantity(const std::vector<QuantityDifference>& all, const std::string& name) {
  return *std::ranges::find(all, name, &QuantityDifference::name);
}

TEST_F(Reproduced, TheSameRunHasTheSameBitsWithAnyNumberOfThreads) {
  const RecordsReader a = recorded("a", Mode::coupled, 1, {"b1", 1, 1}), b = recorded("b", Mode::coupled, 1, {"b1", 2, 1});
  const Reproduction r = reproduction(a, b, 0);
  EXPECT_EQ(r.verdict(), Verdict::same_bits);
  EXPECT_TRUE(r.bits_expected);
  EXPECT_TRUE(std::ranges::all_of(r.quantities, &QuantityDifference::same_bits));
  EXPECT_THAT(reproduction_text(r), AllOf(HasSubstr("threads: 1; now 2"), HasSubstr("reproduced: the same bits"),
                                          Not(HasSubstr("largest differences"))));
}

TEST_F(Reproduced, EachQuantityTellsItsLargestDifferenceAndWhen) {
  const RecordsReader a = recorded("a", Mode::coupled, 1, {}), c = recorded("c", Mode::coupled, 1.01, {});
  const std::vector<QuantityDifference> all = differences(a, c);
  const QuantityDifference& force = quantity(all, "force on wall");
  const std::vector<double> fx = c.force("wall", "fx"), time = c.force("wall", "time");
  const double most = std::ranges::max(fx);
  EXPECT_NEAR(force.largest, 0.01 / 1.01 * most, 1e-12);
  EXPECT_NEAR(force.relative(), 0.01 / 1.01, 1e-12);
  const auto when = std::ranges::find(time, force.time);
  ASSERT_NE(when, time.end());
  EXPECT_NEAR(fx[std::size_t(when - time.begin())], most, 1e-9);
  EXPECT_FALSE(force.overall);
  EXPECT_NEAR(quantity(all, "impulse on wall").relative(), 0.01 / 1.01, 1e-12);
  EXPECT_TRUE(quantity(all, "impulse on wall").overall);
  EXPECT_TRUE(quantity(all, "final depth").same_bits);
  EXPECT_EQ(quantity(all, "final volume that lies elsewhere").largest, 0);
  EXPECT_TRUE(quantity(all, "mass ledger").same_bits);
  EXPECT_GT(quantity(all, "momentum ledger").largest, 0);
}

TEST_F(Reproduced, OneBuildOnOneMachineMustGiveTheSameBits) {
  const RecordsReader a = recorded("a", Mode::coupled, 1, {"b1"}), c = recorded("c", Mode::coupled, 1 + 1e-12, {"b1"});
  const Reproduction r = reproduction(a, c, 1);
  EXPECT_EQ(r.verdict(), Verdict::differs);
  EXPECT_THAT(reproduction_text(r),
              HasSubstr("NOT reproduced: the same build on the same kind of machine must give the same bits"));
}

TEST_F(Reproduced, AnotherBuildIsHeldToTheTolerance) {
  const RecordsReader a = recorded("a", Mode::continuum, 1, {"b1"}), c = recorded("c", Mode::continuum, 1.01, {"b2"});
  EXPECT_EQ(reproduction(a, c, 0.02).verdict(), Verdict::within);
  const Reproduction beyond = reproduction(a, c, 0.005);
  EXPECT_EQ(beyond.verdict(), Verdict::differs);
  EXPECT_THAT(reproduction_text(beyond),
              AllOf(HasSubstr("build: b1; now b2"), HasSubstr("BEYOND"), HasSubstr("beyond the tolerance of 0.005")));
}

// A single window's force is told, its impulse is judged.
TEST_F(Reproduced, WithGrainsOnlyWhatIsOverallIsJudged) {
  const RecordsReader a = recorded("a", Mode::coupled, 1, {"b1"}), c = recorded("c", Mode::coupled, 1.01, {"b2"});
  Reproduction r = reproduction(a, c, 0.02);
  EXPECT_EQ(r.verdict(), Verdict::within);
  for (QuantityDifference& q : r.quantities)
    if (q.name == "force on wall") q.largest = 1e3;
  EXPECT_EQ(r.verdict(), Verdict::within);
  for (QuantityDifference& q : r.quantities)
    if (q.name == "impulse on wall") q.largest = 1e3;
  EXPECT_EQ(r.verdict(), Verdict::differs);
}

TEST_F(Reproduced, WhatOnlyOneOfTheTwoHasIsBeyondAnyTolerance) {
  SyntheticRun with(Mode::coupled);
  with.stresses = true;
  record(with, folder / "with", {"b1"});
  const RecordsReader a(folder / "with/records.h5"), b = recorded("b", Mode::coupled, 1, {"b2"});
  const Reproduction r = reproduction(a, b, 0.5);
  const QuantityDifference& q = quantity(r.quantities, "stress at wall/middle");
  EXPECT_TRUE(std::isnan(q.largest));
  EXPECT_FALSE(r.holds(q));
  EXPECT_THAT(reproduction_text(r), HasSubstr("only one of the two has it"));
  EXPECT_EQ(reproduction_json(r)["quantities"][0]["judged"], false);
}

}  // namespace
}  // namespace couloir::testing
