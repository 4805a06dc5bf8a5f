#include "coupling/check/expected.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "check_folder.hpp"
#include "coupling/cases/case_unit.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

Expected read(const std::string& text, const CaseChoice& choice = {}) {
  const CheckFolder folder("expected");
  return read_expected(folder.write("slab/expected.yaml", text), choice);
}

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

constexpr const char* one_case = R"(
cases:
  - name: slab
    expect:
      - {quantity: mass.initial, value: 400 g, tolerance: 0.1 %, evidence: exact, source: geometry}
)";

TEST(Expected, ReadsACase) {
  const Expected e = read(one_case);
  ASSERT_EQ(e.cases.size(), 1u);
  const CheckCase& c = e.cases[0];
  EXPECT_EQ(c.name, "slab");
  EXPECT_THAT(c.scene, HasSubstr("slab/scene.yaml"));
  ASSERT_EQ(c.expect.size(), 1u);
  EXPECT_EQ(c.expect[0].value, 400);
  EXPECT_DOUBLE_EQ(c.expect[0].unit.si, 1e-3);
  EXPECT_EQ(c.expect[0].tolerance.kind, Tolerance::Kind::relative);
  EXPECT_DOUBLE_EQ(c.expect[0].tolerance.size, 1e-3);
  EXPECT_THAT(c.expect[0].place, HasSubstr("expected.yaml:5"));
}

constexpr const char* table = R"(
variants:
  default: {}
  seed: {continuum.closure: active_passive}
tables:
  - name: angles
    set: {continuum.cell: 5 mm}
    evidence: seed table
    source: Table 1
    columns:
      - {set: terrain.angle}
      - {set: release.position, value: "[{}, 0]"}
      - {quantity: flow.max_speed, unit: m/s, tolerance: {seed: 5 %, default: none}}
      - {quantity: mass.initial, unit: g, tolerance: 1 g, variants: [seed], evidence: exact, source: geometry}
    rows:
      - [30 deg, 0.1 m, 0.2, 400]
      - [35 deg, 0.2 m, {value: 0.3, tolerance: 50 %}, ~]
)";

TEST(Expected, SpellsTablesOut) {
  const Expected e = read(table);
  ASSERT_EQ(e.cases.size(), 4u);
  EXPECT_EQ(e.cases[0].name, "angles, 30 deg / 0.1 m");
  EXPECT_EQ(e.cases[0].variant, "default");
  EXPECT_EQ(e.cases[0].expect.size(), 1u);
  EXPECT_EQ(e.cases[0].expect[0].tolerance.kind, Tolerance::Kind::none);
  EXPECT_EQ(e.cases[0].expect[0].source, "Table 1 row 1");
  const CheckCase& seed = e.cases[1];
  EXPECT_THAT(seed.set, ElementsAre(Pair("continuum.closure", "active_passive"), Pair("continuum.cell", "5 mm"),
                                    Pair("terrain.angle", "30 deg"), Pair("release.position", "[0.1 m, 0]")));
  ASSERT_EQ(seed.expect.size(), 2u);
  EXPECT_EQ(seed.expect[0].value, 0.2);
  EXPECT_EQ(seed.expect[1].tolerance.kind, Tolerance::Kind::absolute);
  EXPECT_EQ(seed.expect[1].evidence, "exact");
  EXPECT_EQ(seed.expect[1].source, "geometry");
  ASSERT_EQ(e.cases[3].expect.size(), 1u);
  EXPECT_DOUBLE_EQ(e.cases[3].expect[0].tolerance.size, 0.5);
  EXPECT_EQ(read(table, {false, {"seed"}}).cases.size(), 2u);
}

TEST(Expected, QuickSkipsReplacesOrAdds) {
  const std::string text = R"(
cases:
  - {name: long, quick: skip, expect: [{quantity: time.wall, value: 1 s, tolerance: none, evidence: exact, source: s}]}
  - {name: same, quick: {duration: 1 s}, expect: [{quantity: time.wall, value: 1 s, tolerance: none, evidence: exact, source: s}]}
  - {name: short, quick: only, expect: [{quantity: time.wall, value: 1 s, tolerance: none, evidence: exact, source: s}]}
)";
  const Expected slow = read(text), quick = read(text, {true, {}});
  ASSERT_EQ(slow.cases.size(), 2u);
  EXPECT_TRUE(slow.cases[1].set.empty());
  ASSERT_EQ(quick.cases.size(), 3u);
  EXPECT_TRUE(quick.cases[0].skipped);
  EXPECT_THAT(quick.cases[1].set, ElementsAre(Pair("duration", "1 s")));
}

TEST(Expected, QuickKeepsTheRowsThatItNames) {
  std::string rows = table;
  const auto quick = [&](const std::string& words) {
    rows = table;
    return rows.replace(rows.find("evidence: seed table"), 20, "evidence: seed table\n    quick: " + words);
  };
  const Expected short_one = read(quick("[2]"), {true, {"seed"}});
  ASSERT_EQ(short_one.cases.size(), 2u);
  EXPECT_TRUE(short_one.cases[0].skipped);
  EXPECT_FALSE(short_one.cases[1].skipped);
  EXPECT_FALSE(read(quick("[2]"), {false, {"seed"}}).cases[0].skipped);
  EXPECT_THAT(error_of(quick("[3]")), HasSubstr("quick names row '3', but there are 2"));
  EXPECT_THAT(error_of(quick("[two]")), HasSubstr("quick names row 'two', but there are 2"));
  EXPECT_THAT(error_of("cases: [{name: a, quick: [1], expect: []}]"), HasSubstr("must be skip, only, or a mapping of overrides"));
}

TEST(Expected, TheCommandLineHasTheLastWord) {
  const std::string text = R"(
cases:
  - name: slab
    set: {grains.engine: liggghts}
    quick: {duration: 1 s}
    expect: [{quantity: time.wall, value: 1 s, tolerance: none, evidence: exact, source: s}]
)";
  const Expected e = read(text, {true, {}, {{"grains.engine", "yade"}}});
  ASSERT_EQ(e.cases.size(), 1u);
  EXPECT_THAT(e.cases[0].set,
              ElementsAre(Pair("grains.engine", "liggghts"), Pair("duration", "1 s"), Pair("grains.engine", "yade")));
}

TEST(Expected, NamesPlaceAndNearestKey) {
  std::string text = one_case;
  text.replace(text.find("tolerance"), 9, "tolerence");
  EXPECT_THAT(error_of(text), HasSubstr("expected.yaml:5: tolerence is unknown; did you mean 'tolerance'?"));
  text = one_case;
  text.replace(text.find("expect:"), 7, "exspect:");
  EXPECT_THAT(error_of(text), HasSubstr("expected.yaml:4: exspect is unknown; did you mean 'expect'?"));
  EXPECT_THAT(error_of("case: []"), HasSubstr("expected.yaml:1: case is unknown; did you mean 'cases'?"));
}

TEST(Expected, RefusesWhatCannotBeMeant) {
  const auto with = [](const std::string& old, const std::string& now) {
    std::string text = one_case;
    text.replace(text.find(old), old.size(), now);
    return error_of(text);
  };
  EXPECT_THAT(with("400 g", "400 mm"), HasSubstr("mass.initial is in mm, but is a mass; write kg, g, t"));
  EXPECT_THAT(with("400 g", "400"), HasSubstr("mass.initial has no unit, but is a mass; write kg, g, t"));
  EXPECT_THAT(with("400 g", "400, unit: kgg"), HasSubstr("unit is 'kgg', which is no unit; did you mean 'kg'?"));
  EXPECT_THAT(with("400 g", "4 0 g"), HasSubstr("value is '4 0 g', but a unit is a name such as N"));
  EXPECT_THAT(with("mass.initial, value: 400 g", "mass.relative_error, value: 1 kg"),
              HasSubstr("mass.relative_error is in kg, but is a plain number; write %, 1"));
  EXPECT_THAT(with("400 g", "400 kgg"), HasSubstr("value is '400 kgg', but 'kgg' is no unit; did you mean 'kg'?"));
  EXPECT_THAT(with("400 g", "heavy"), HasSubstr("must be a number with a unit"));
  EXPECT_THAT(with("evidence: exact", "evidence: guess"), HasSubstr("must be one of exact, seed table, measured, regression"));
  EXPECT_THAT(with("mass.initial", "critical"), HasSubstr("needs a search"));
  EXPECT_THAT(with(", source: geometry", ""), HasSubstr("source is missing"));
  EXPECT_THAT(with("tolerance: 0.1 %", "tolerance: 1 mm"), HasSubstr("give % or the unit of the value"));
}

TEST(Expected, RefusesAShareOfNothing) {
  const auto with = [](const std::string& value, const std::string& tolerance) {
    std::string text = one_case;
    text.replace(text.find("400 g"), 5, value);
    text.replace(text.find("0.1 %"), 5, tolerance);
    return error_of(text);
  };
  EXPECT_THAT(with("0 g", "5 %"),
              HasSubstr("expected.yaml:5: mass.initial is expected to be 0, of which every share is 0, but its "
                        "tolerance is 5 %; give a number without %, in the unit of the value, or none"));
  EXPECT_EQ(with("0 g", "5 g"), "");
  EXPECT_EQ(with("0 g", "none"), "");
  EXPECT_EQ(with("1 g", "0 %"), "");
  // In a table the cell is at fault, which may have a tolerance of its own.
  std::string rows = table;
  rows.replace(rows.find("{value: 0.3, tolerance: 50 %}"), 29, "0");
  EXPECT_THAT(error_of(rows), HasSubstr("expected.yaml:17: flow.max_speed is expected to be 0"));
  rows.replace(rows.find(", 0, ~]"), 7, ", {value: 0, tolerance: 0.1}, ~]");
  EXPECT_EQ(error_of(rows), "");
}

TEST(CaseUnit, KnowsScalesAndForces) {
  EXPECT_DOUBLE_EQ(parse_case_unit("33.33 mm").si, 0.03333);
  EXPECT_EQ(parse_case_unit("33.33 mm").quantity, "a length");
  EXPECT_EQ(parse_case_unit("N s").quantity, "an impulse");
  EXPECT_EQ(parse_case_value("-1.5e3 kN").first, -1500);
  EXPECT_DOUBLE_EQ(parse_case_value("2 kN").second.si, 1000);
  EXPECT_THROW(parse_case_unit("33"), std::invalid_argument);
  EXPECT_EQ(quantity_of_path("obstacles.wall.force_peak_time"), "a time");
  EXPECT_EQ(quantity_of_path("obstacles.wall.depth_on_top_final"), "a length");
  EXPECT_EQ(quantity_of_path("obstacles.wall.max_climbed"), "a length");
  EXPECT_EQ(quantity_of_path("obstacles.wall.gauges.middle.normal_peak"), "a pressure");
  EXPECT_EQ(quantity_of_path("obstacles.wall.gauges.middle.shear_up_final"), "a pressure");
  EXPECT_EQ(quantity_of_path("obstacles.wall.gauges.middle.normal_peak_time"), "a time");
  EXPECT_EQ(quantity_of_path("obstacles.wall.gauges.middle.normal_impulse"), "");
  EXPECT_EQ(quantity_of_path("obstacles.wall.overflow"), "a mass");
}

}  // namespace
}  // namespace couloir
