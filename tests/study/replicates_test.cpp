#include <gtest/gtest.h>

#include <cmath>

#include "coupling/cases/packings.hpp"
#include "coupling/study/study_run.hpp"

namespace couloir {
namespace {

StudyResult done(double value) {
  StudyResult r;
  r.status = StudyResult::Status::done;
  r.values = {value};
  r.mean = r.scatter = {std::nan("")};
  return r;
}

Study groups(const std::vector<int>& of) {
  Study study;
  for (const int group : of) {
    StudyRow& row = study.rows.emplace_back();
    row.group = group;
    row.quantities.push_back({"flow.max_speed", "speed", {}});
  }
  return study;
}

TEST(Replicates, MeanAndScatterAreOfTheDoneRowsOfAGroup) {
  const Study study = groups({0, 0, 0, 0, 1});
  std::vector<StudyResult> r{done(2), done(4), done(9), done(100), done(7)};
  r[3].status = StudyResult::Status::failed;
  add_replicates(study, r);
  for (int k = 0; k < 3; ++k) {
    EXPECT_DOUBLE_EQ(r[k].mean[0], 5);
    EXPECT_DOUBLE_EQ(r[k].scatter[0], std::sqrt((9 + 1 + 16) / 2.0));  // n - 1
    EXPECT_EQ(r[k].replicates, 3);
  }
  EXPECT_TRUE(std::isnan(r[3].mean[0]));
  EXPECT_EQ(r[3].replicates, 0);
  EXPECT_DOUBLE_EQ(r[4].mean[0], 7);
  EXPECT_TRUE(std::isnan(r[4].scatter[0])) << "one value has no scatter";
}

TEST(Replicates, AValueThatIsNotThereIsLeftOut) {
  const Study study = groups({0, 0, 0});
  std::vector<StudyResult> r{done(2), done(std::nan("")), done(4)};
  add_replicates(study, r);
  EXPECT_DOUBLE_EQ(r[1].mean[0], 3);
  EXPECT_DOUBLE_EQ(r[1].scatter[0], std::sqrt(2.0));
}

PackingRun packing(long seed, double peak) {
  return {seed,
          "run" + std::to_string(seed),
          "",
          {{"obstacles", {{"wall", {{"force_peak", peak}}}}}, {"walls", nlohmann::json::object()}}};
}

TEST(Packings, EachFigureHasAMeanAndAScatter) {
  std::vector<PackingRun> runs{packing(1, 2), packing(2, 4), packing(3, 9)};
  runs.push_back({4, "", "the grain engine failed", nullptr});
  runs[1].summary["obstacles"]["wall"]["first_contact"] = 0.3;
  runs[0].summary["obstacles"]["wall"]["first_contact"] = nullptr;  // the flow did not touch it
  for (int k : {0, 1, 2}) runs[k].summary["obstacles"]["wall"]["gauges"]["middle"]["normal_peak"] = 100 * (k + 1);
  for (int k : {0, 1, 2}) runs[k].summary["obstacles"]["wall"]["gauges"]["unread"]["normal_peak"] = nullptr;
  const nlohmann::json all = over_packings(runs);
  EXPECT_EQ(all["count"], 3);
  EXPECT_EQ(all["seeds"], nlohmann::json({1, 2, 3}));
  EXPECT_EQ(all["failed"], nlohmann::json::array({{{"seed", 4}, {"reason", "the grain engine failed"}}}));
  const nlohmann::json& peak = all["obstacles"]["wall"]["force_peak"];
  EXPECT_DOUBLE_EQ(peak["mean"], 5);
  EXPECT_DOUBLE_EQ(peak["scatter"], std::sqrt((9 + 1 + 16) / 2.0));
  const nlohmann::json& stress = all["obstacles"]["wall"]["gauges"]["middle"]["normal_peak"];
  EXPECT_DOUBLE_EQ(stress["mean"], 200);
  EXPECT_DOUBLE_EQ(stress["scatter"], 100);
  EXPECT_FALSE(all["obstacles"]["wall"]["gauges"].contains("unread"));
  EXPECT_EQ(peak["least"], 2.0);
  EXPECT_EQ(peak["largest"], 9.0);
  EXPECT_EQ(all["obstacles"]["wall"]["first_contact"]["count"], 1) << "which only one run has";
}

}  // namespace
}  // namespace couloir
