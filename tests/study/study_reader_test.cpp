#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_folder.hpp"

namespace couloir {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

std::vector<std::string> names(const Study& study) {
  std::vector<std::string> out;
  for (const StudyRow& row : study.rows) out.push_back(row.name + " " + row.variant);
  return out;
}

constexpr const char* grid = R"(
variants:
  default: {}
  other: {continuum.closure: active_passive, continuum.cell: 20 mm}
quantities: [mass.initial]
tables:
  - name: grid
    set: {continuum.cfl: 0.4}
    columns:
      - {set: terrain.angle, values: [30 deg, 35 deg], name: slope}
      - {set: release.position, value: "[{}, 0]", values: [0.1 m, 0.2 m]}
)";

TEST(StudyReader, TakesEveryCombinationOfTheColumns) {
  const Study study = read_slab_study(grid);
  EXPECT_EQ(study.name, "slab");
  EXPECT_THAT(names(study),
              ElementsAre("grid, 30 deg / 0.1 m default", "grid, 30 deg / 0.2 m default", "grid, 35 deg / 0.1 m default",
                          "grid, 35 deg / 0.2 m default", "grid, 30 deg / 0.1 m other", "grid, 30 deg / 0.2 m other",
                          "grid, 35 deg / 0.1 m other", "grid, 35 deg / 0.2 m other"));
  const StudyRow& row = study.rows[5];
  EXPECT_THAT(row.set,
              ElementsAre(Pair("continuum.closure", "active_passive"), Pair("continuum.cell", "20 mm"),
                          Pair("continuum.cfl", "0.4"), Pair("terrain.angle", "30 deg"), Pair("release.position", "[0.2 m, 0]")));
  EXPECT_EQ(row.mode, "continuum");
  EXPECT_EQ(row.seed, 0);
  EXPECT_EQ(study.parameters[0].label, "slope");
  EXPECT_EQ(study.quantities[0].unit.text, "kg");
  EXPECT_GT(row.planned, 0);
  EXPECT_EQ(read_slab_study(grid, {false, {"other"}}).rows.size(), 4u);
}

TEST(StudyReader, TakesRowsAndTheirReferences) {
  const Study study = read_slab_study(R"(
tables:
  - name: rows
    quantities: [{quantity: flow.max_speed, unit: mm/s}]
    columns:
      - {set: terrain.angle}
      - {set: continuum.cell}
      - {reference: flow.max_speed, unit: m/s, source: Table 1}
    rows:
      - [30 deg, 0.01, 0.2]
      - [35 deg, 20 mm, ~]
)");
  ASSERT_EQ(study.rows.size(), 2u);
  ASSERT_EQ(study.rows[0].references.size(), 1u);
  EXPECT_DOUBLE_EQ(study.rows[0].references[0].second.value, 200);
  EXPECT_TRUE(study.rows[1].references.empty());
  EXPECT_EQ(study.rows[0].units[1].second.text, "m") << "a bare number is in SI where the scene has no scales";
}

TEST(StudyReader, ModesAndSeeds) {
  const auto with = [](const std::string& replicates) {
    return read_slab_study(
        "modes: [continuum, grains]\nreplicates: " + replicates +
        "\nquantities: [mass.initial]\ntables: [{name: t, set: {material.diameter: 5 mm, grains.diameter: 5 mm}}]\n");
  };
  const Study counted = with("3");
  ASSERT_EQ(counted.rows.size(), 4u) << "nothing is random in the continuum: one row";
  EXPECT_EQ(counted.rows[0].mode, "continuum");
  for (int k = 1; k <= 3; ++k) {
    EXPECT_EQ(counted.rows[k].seed, 20010 + k);
    EXPECT_EQ(counted.rows[k].group, counted.rows[1].group);
    EXPECT_EQ(counted.rows[k].set.back(), (std::pair<std::string, std::string>("grains.seed", std::to_string(20010 + k))));
  }
  EXPECT_NE(counted.rows[0].group, counted.rows[1].group);
  const Study named = with("[7, 3]");
  ASSERT_EQ(named.rows.size(), 3u);
  EXPECT_EQ(named.rows[1].seed, 7);
  EXPECT_EQ(named.rows[2].seed, 3);
}

TEST(StudyReader, QuickLeavesOutAddsAndSets) {
  const std::string text = R"(
quantities: [mass.initial]
tables:
  - {name: long, quick: skip}
  - {name: same, quick: {duration: 10 ms}}
  - {name: short, quick: only, set: {duration: 20 ms}}
)";
  EXPECT_THAT(names(read_slab_study(text)), ElementsAre("long ", "same "));
  const Study quick = read_slab_study(text, {true, {}});
  EXPECT_THAT(names(quick), ElementsAre("same ", "short "));
  EXPECT_THAT(quick.rows[0].set, ElementsAre(Pair("duration", "10 ms")));
}

TEST(StudyReader, ASearchShowsItsCriticalValueFirst) {
  const Study study = read_slab_study(R"(
quantities: [mass.initial]
tables:
  - name: s
    search: {key: material.basal_friction_angle, from: 20 deg, to: 28 deg, step: 0.5 deg, quantity: gauges.middle.max_speed, bound: 0.1 m/s}
)");
  ASSERT_EQ(study.rows[0].quantities.size(), 2u);
  EXPECT_EQ(study.rows[0].quantities[0].path, "critical");
  EXPECT_EQ(study.rows[0].quantities[0].unit.text, "deg");
  EXPECT_EQ(study.rows[0].search->most_runs(), 6);
}

// The same quantities in all modes: no value where no grains meet the obstacle.
TEST(StudyReader, KnowsStressesOnGauges) {
  const std::string text = R"(
modes: [continuum, grains]
quantities: [{quantity: obstacles.wall.gauges.m.normal_peak, unit: kPa}, obstacles.wall.gauges.m.shear_up_final]
tables:
  - name: t
    set:
      grains.diameter: 4 mm
      obstacles: {wall: {position: [0.8 m, 0], size: [20 mm, 100 mm, 40 mm], gauges: {m: {centre: [0, 20 mm], radius: 10 mm}}}}
    columns: [{set: terrain.angle, values: [30 deg, 35 deg]}]
)";
  EXPECT_EQ(study_error(text), "");
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string other = text;
    other.replace(other.find(old), old.size(), now);
    return study_error(other);
  };
  EXPECT_THAT(with("normal_peak", "normal_pek"), HasSubstr("did you mean 'normal_peak'?"));
  EXPECT_THAT(with("unit: kPa", "unit: N"), HasSubstr("normal_peak is a pressure; write Pa, kPa, MPa"));
}

TEST(StudyReader, NamesPlaceAndNearestName) {
  const auto with = [](const std::string& old, const std::string& now) {
    std::string text = grid;
    text.replace(text.find(old), old.size(), now);
    return study_error(text);
  };
  EXPECT_THAT(with("tables:", "tabels:"), HasSubstr("study.yaml:6: tabels is unknown; did you mean 'tables'?"));
  EXPECT_THAT(with("values: [30", "valeus: [30"), HasSubstr("study.yaml:10: valeus is unknown; did you mean 'values'?"));
  EXPECT_THAT(with("terrain.angle", "terrain.angel"), HasSubstr("did you mean 'angle'?"));
  EXPECT_THAT(with("[30 deg, 35 deg]", "[30 deg, 35 kg]"), HasSubstr("study.yaml:7: grid, 35 kg / 0.1 m: "));
  EXPECT_THAT(with("mass.initial", "mass.initail"), HasSubstr("study.yaml:5: the quantity mass.initail is not in the run's "
                                                              "summary.json: initail is unknown; did you mean 'initial'?"));
  EXPECT_THAT(with("mass.initial", "gauges.midle.max_speed / time.simulated"), HasSubstr("did you mean 'middle'?"));
  EXPECT_THAT(with("[mass.initial]", "[{quantity: mass.initial, unit: mm}]"),
              HasSubstr("mass.initial is a mass; write kg, g, t"));
  EXPECT_THAT(with("[mass.initial]", "[critical]"), HasSubstr("quantities are missing"));
  EXPECT_THAT(with("variants:", "modes: [continum]\nvariants:"), HasSubstr("did you mean 'continuum'?"));
  EXPECT_THAT(with("variants:", "replicates: many\nvariants:"), HasSubstr("must be a whole number from 1 to 1000"));
}

TEST(StudyReader, RefusesWhatCannotBeMeant) {
  const auto table = [](const std::string& more) {
    return study_error("quantities: [mass.initial]\ntables:\n  - name: t\n" + more);
  };
  EXPECT_THAT(table("    columns: [{set: duration}]\n"), HasSubstr("study.yaml:4: values are missing"));
  EXPECT_THAT(table("    columns: [{set: duration, values: [1 s]}]\n    rows: [[1 s]]\n"), HasSubstr("keep one of the two"));
  EXPECT_THAT(table("    columns: [{set: duration}]\n    rows: [[1 s, 2 s]]\n"), HasSubstr("a value for each of the 1 columns"));
  EXPECT_THAT(table("    columns: [{set: duration}]\n    rows: []\n"), HasSubstr("rows are empty"));
  EXPECT_THAT(table("    columns: [{set: duration, values: [1 s]}, {set: duration, values: [1 s]}]\n"),
              HasSubstr("is a column already"));
  EXPECT_THAT(table("    quick: {duration: 1 s}\n    columns: [{set: duration, values: [1 s]}]\n"),
              HasSubstr("duration is a column of this table, but quick sets duration"));
  EXPECT_THAT(table("    columns: [{set: duration}, {reference: mass.final, source: s}]\n    rows: [[1 s, 1 kg]]\n"),
              HasSubstr("mass.final is no quantity of this table; did you mean 'mass.initial'?"));
  EXPECT_THAT(table("    columns: [{set: duration}, {reference: mass.initial, source: s}]\n    rows: [[1 s, 1 N]]\n"),
              HasSubstr("the reference is in N, but mass.initial in kg"));
  EXPECT_THAT(table("    modes: [continuum]\n    columns: [{set: mode, values: [continuum]}]\n"), HasSubstr("there are modes"));
  EXPECT_THAT(table("    columns: [{set: continuum.cell, values: [1e-9 m]}]\n"), HasSubstr("study.yaml:3: t, 1e-9 m: "));
  EXPECT_THAT(study_error("title: nothing\n"), HasSubstr("study.yaml:1: there is nothing to run; give tables"));
  const std::string slopes =
      "quantities: [mass.initial]\ntables:\n  - name: t\n    columns: [{set: terrain.angle, values: [30 deg]}]\n";
  EXPECT_THAT(study_error(slopes, {false, {}, {{"terrain.angle", "40 deg"}}}),
              HasSubstr("terrain.angle is a column of this table, but --set gives terrain.angle"));
}

}  // namespace
}  // namespace couloir
