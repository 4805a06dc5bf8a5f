#include "coupling/study/ladder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/study/study_table.hpp"
#include "study_folder.hpp"

namespace couloir {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// m = g (sin 30 - tan 20 cos 30) for 0.1 s.
constexpr const char* ladder_of_the_slab = R"(
ladder:
  quantities: [{quantity: gauges.middle.max_speed, unit: mm/s}]
  reference: [{quantity: gauges.middle.max_speed, value: 0.18128147 m/s, source: exact}]
  errors: [30 %, 1 %]
  set: {continuum.cfl: 0.4}
  rungs:
    - {name: point, mode: mass point}
    - {name: coarse, set: {continuum.cell: 40 mm}}
    - {name: fine, mode: continuum, set: {continuum.cell: 10 mm, continuum.cfl: 0.3}}
)";

// A ladder of a random cheap, a sure middle and a random dear rung, the dear one its own reference.
Study made_up() {
  Study study;
  Ladder& ladder = study.ladder.emplace();
  ladder.quantities = {{"obstacles.wall.impulse", "impulse", parse_case_unit("N s")}};
  ladder.reference = 2;
  for (const char* name : {"cheap", "middle", "dear"}) ladder.rungs.push_back({name, "grains", {}, 1, 1, 1});
  const int rungs[] = {0, 0, 1, 2, 2};
  for (const int rung : rungs) {
    StudyRow& row = study.rows.emplace_back();
    row.rung = rung, row.quantities = ladder.quantities, row.group = rung, row.seed = 1;
  }
  return study;
}

std::vector<StudyResult> results_of(const std::vector<double>& values, const std::vector<double>& cpu) {
  std::vector<StudyResult> out(values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    out[k].status = StudyResult::Status::done, out[k].values = {values[k]}, out[k].cpu = cpu[k];
  return out;
}

TEST(Ladder, ErrorIsBiasAndScatterOfOneRunAgainstTheReference) {
  const Study study = made_up();
  const auto results = results_of({9, 15, 11, 8, 12}, {1, 3, 5, 50, 70});
  const LadderFigures f = ladder_figures(study, results)[0];
  const double root2 = std::sqrt(2.0);
  EXPECT_DOUBLE_EQ(f.reference, 10);
  EXPECT_DOUBLE_EQ(f.floor, 4 / root2 / 10);
  EXPECT_DOUBLE_EQ(f.rungs[0].bias, 0.2);
  EXPECT_DOUBLE_EQ(f.rungs[0].scatter, 6 / root2 / 10);
  EXPECT_DOUBLE_EQ(f.rungs[0].error, std::sqrt(0.04 + 0.18));
  EXPECT_DOUBLE_EQ(f.rungs[0].doubt, std::sqrt(0.18 / 2 + 0.08 / 2));
  EXPECT_DOUBLE_EQ(f.rungs[1].error, 0.1);
  EXPECT_DOUBLE_EQ(f.rungs[2].bias, 0);
  EXPECT_DOUBLE_EQ(f.rungs[2].error, f.floor);
  EXPECT_DOUBLE_EQ(rung_costs(study, results)[0].cpu, 2);
  EXPECT_TRUE(f.rungs[0].front && f.rungs[1].front);
  EXPECT_FALSE(f.rungs[2].front) << "middle is cheaper and better";
}

TEST(Ladder, TakesTheCheapestRungOrTheMeanOfSomePackings) {
  const std::vector<RungFigures> rungs{{.value = 1, .bias = 0.3, .scatter = 0, .error = 0.3},
                                       {.value = 1, .bias = 0.06, .scatter = 0.16, .error = 0.171},
                                       {.value = 1, .bias = 0, .scatter = 0.04, .error = 0.04}};
  const std::vector<RungCost> costs{{1, 1}, {3, 10}, {3, 100}};
  EXPECT_EQ(choose(0.3, rungs, costs).rung, 0);
  const LadderChoice ten = choose(0.1, rungs, costs);
  EXPECT_EQ(ten.rung, 1);
  EXPECT_EQ(ten.packings, 4);  // 0.06^2 + 0.16^2 / 4 = 0.1^2
  EXPECT_NEAR(ten.error, 0.1, 1e-12);
  EXPECT_EQ(ten.cpu, 40);
  EXPECT_EQ(choose(0.05, rungs, costs).rung, 2) << "no mean takes a bias away";
  EXPECT_EQ(choose(0.001, rungs, costs).rung, -1) << "that would be 1600 packings";
  const std::vector<RungFigures> exact{{.value = 1}};
  EXPECT_EQ(choose(0.001, exact, {{1, 1}}).rung, 0);
}

// 4 cells in the depth are right by chance: 8 are off by 10 %.
TEST(Ladder, ARungThatIsRightByChanceIsNotTaken) {
  Study study = made_up();
  Ladder& ladder = *study.ladder;
  ladder.reference = -1;
  ladder.values = {{100, "exact"}};
  for (std::size_t k = 0; k < 3; ++k) {
    const double cells = std::ldexp(4, int(k));
    ladder.rungs[k] = {std::to_string(k), "continuum", {{"continuum.cell", fmt::format("{} mm", 80 / cells)}}, cells, NAN, 1};
  }
  auto results = results_of({100, 100, 110, 102, 102}, {1, 1, 2, 4, 4});
  const LadderFigures f = ladder_figures(study, results)[0];
  EXPECT_EQ(f.rungs[0].error, 0);
  EXPECT_DOUBLE_EQ(f.rungs[0].step, 0.1);
  EXPECT_DOUBLE_EQ(f.rungs[1].step, 0.08);
  EXPECT_EQ(f.rungs[2].step, 0);
  EXPECT_EQ(choose(0.05, f.rungs, rung_costs(study, results)).rung, 2);
  EXPECT_EQ(choose(0.11, f.rungs, rung_costs(study, results)).rung, 0);
  ladder.rungs[0].set.emplace_back("continuum.limiter", "mc");  // what else differs does not make it true
  EXPECT_DOUBLE_EQ(ladder_figures(study, results)[0].rungs[0].step, 0.1);
  ladder.rungs[1].set.emplace_back("continuum.scheme", "noc");
  EXPECT_DOUBLE_EQ(ladder_figures(study, results)[0].rungs[0].step, 0.02) << "to the third alone: the second is another model";
}

// Its force is right by chance where the flow that it leaves out has another.
TEST(Ladder, AMassPointIsHeldAgainstAllCells) {
  Study study = made_up();
  Ladder& ladder = *study.ladder;
  ladder.reference = -1;
  ladder.values = {{100, "exact"}};
  ladder.rungs[0] = {"point", "mass point", {}, NAN, NAN, 1};
  ladder.rungs[1] = {"fine", "continuum", {{"continuum.cell", "10 mm"}}, 8, NAN, 1};
  ladder.rungs[2] = {"coarse", "continuum", {{"continuum.cell", "20 mm"}}, 4, NAN, 1};
  const auto results = results_of({101, 101, 130, 104, 104}, {1, 1, 2, 4, 4});
  const LadderFigures f = ladder_figures(study, results)[0];
  EXPECT_DOUBLE_EQ(f.rungs[0].step, 0.29);
  EXPECT_DOUBLE_EQ(f.rungs[2].step, 0.26);
  EXPECT_EQ(choose(0.05, f.rungs, rung_costs(study, results)).rung, -1) << "finer cells go away from what coarse ones hit";
}

TEST(Ladder, ARungThatFailedHasNoFigures) {
  const Study study = made_up();
  auto results = results_of({9, 15, 11, 8, 12}, {1, 3, 5, 50, 70});
  results[2].status = StudyResult::Status::failed;
  const LadderFigures f = ladder_figures(study, results)[0];
  EXPECT_TRUE(std::isnan(f.rungs[1].error));
  EXPECT_FALSE(f.rungs[1].front);
  EXPECT_THAT(ladder_text(study, results), HasSubstr("no rung, not even by the mean of 30 packings"));
  EXPECT_TRUE(ladder_json(study, results)["quantities"][0]["rungs"][1]["error"].is_null());
}

TEST(Ladder, IsReadWithItsRungsAsRows) {
  const Study study = read_slab_study(ladder_of_the_slab);
  ASSERT_EQ(study.rows.size(), 3u);
  EXPECT_TRUE(study.rows[0].known);
  EXPECT_EQ(study.rows[0].mode, "mass point");
  EXPECT_FALSE(study.rows[1].known);
  EXPECT_EQ(study.rows[1].name, "coarse");
  EXPECT_THAT(study.rows[1].set, ::testing::ElementsAre(std::pair("continuum.cfl", "0.4"), std::pair("continuum.cell", "40 mm")));
  EXPECT_EQ(study.rows[2].set[1].second, "0.3") << "a rung's own wins";
  const Ladder& ladder = *study.ladder;
  EXPECT_NEAR(ladder.values[0].value, 181.28147, 1e-9);
  EXPECT_THAT(ladder.errors, ::testing::ElementsAre(0.3, 0.01));
  EXPECT_NEAR(ladder.rungs[2].cells_in_depth / ladder.rungs[1].cells_in_depth, 4, 1e-12);
  EXPECT_TRUE(std::isnan(ladder.rungs[2].grains_in_depth));
  // The point is exact where the slab is: at the gauge its middle has gone 50 mm.
  const double m = 9.81 * (std::sin(M_PI / 6) - std::tan(M_PI / 9) * std::cos(M_PI / 6));
  EXPECT_NEAR((*study.rows[0].known)["gauges"]["middle"]["max_speed"].get<double>(), std::sqrt(2 * m * 0.05), 5e-3);
}

TEST(Ladder, ATableShowsErrorsOfItsRungsAlone) {
  const Study study = read_slab_study(std::string(ladder_of_the_slab) + R"(
tables:
  - {name: other, quantities: [mass.initial], columns: [{set: continuum.cell, values: [20 mm]}]}
)");
  std::vector<StudyResult> results(4);
  for (std::size_t k = 0; k < 4; ++k) {
    results[k].status = StudyResult::Status::done, results[k].cpu = 1;
    results[k].values = results[k].mean = results[k].scatter = {k == 0 ? 5.0 : 181.28147 * 1.1};
  }
  const auto table = study_table(study, results);
  const auto column = [&](const std::string& name) { return *std::ranges::find(table, name, &StudyTableColumn::name); };
  EXPECT_EQ(column("rung").texts[0], "");
  EXPECT_EQ(column("rung").texts[1], "point");
  EXPECT_TRUE(std::isnan(column("gauges.middle.max_speed error").numbers[0]));
  EXPECT_NEAR(column("gauges.middle.max_speed error").numbers[3], 0.1, 1e-9);
}

std::string with(const std::string& word, const std::string& other) {
  std::string text = ladder_of_the_slab;
  return text.replace(text.find(word), word.size(), other);
}

TEST(Ladder, WrongWordsAreToldWithTheirPlace) {
  EXPECT_THAT(study_error(with("name: coarse", "nam: coarse")), HasSubstr("study.yaml:9: nam is unknown; did you mean 'name'?"));
  EXPECT_THAT(study_error(with("name: fine", "name: coarse")), HasSubstr("'coarse' is a rung already"));
  EXPECT_THAT(study_error(with("mode: continuum", "mode: mass pint")), HasSubstr("modes: 'mass pint' is none"));
  EXPECT_THAT(study_error(with("30 %", "0 %")), HasSubstr("errors holds 0 %, but takes shares above 0"));
  EXPECT_THAT(study_error(with("30 %", "3 mm")), HasSubstr("errors holds 3 mm"));
  EXPECT_THAT(study_error(with("value: 0.18128147 m/s, source: exact", "value: 1 m/s")),
              HasSubstr("say where the reference comes from"));
  EXPECT_THAT(study_error(with("0.18128147 m/s", "0 m/s")), HasSubstr("an error over it has no meaning"));
  EXPECT_THAT(study_error(with("0.18128147 m/s", "3 N")),
              HasSubstr("the reference is in N, but gauges.middle.max_speed in mm/s"));
  const std::string values = "reference: [{quantity: gauges.middle.max_speed, value: 0.18128147 m/s, source: exact}]";
  EXPECT_THAT(study_error(with(values, "reference: fin")), HasSubstr("'fin' is no rung; did you mean 'fine'?"));
  EXPECT_THAT(study_error(with(values, "reference: point")), HasSubstr("a mass point is no reference"));
  EXPECT_THAT(study_error(with(values, "reference: []")), HasSubstr("there is no value for gauges.middle.max_speed"));
  EXPECT_THAT(study_error("variants: {a: {}, b: {}}\n" + std::string(ladder_of_the_slab)),
              HasSubstr("a ladder stands in a file without variants"));
  std::string skipped = with(values, "reference: fine");
  skipped.replace(skipped.find("name: fine,"), 11, "name: fine, quick: skip,");
  EXPECT_THAT(study_error(skipped, {true, {}, {}}), HasSubstr("the reference, 'fine', is left out by --quick"));
  EXPECT_THAT(study_error(skipped), "");
}

}  // namespace
}  // namespace couloir
