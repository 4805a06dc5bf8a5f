#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/study/study_table.hpp"
#include "coupling/study/study_unit.hpp"
#include "study_folder.hpp"

namespace couloir {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

const StudyTableColumn& column(const std::vector<StudyTableColumn>& table, const std::string& name) {
  return *std::ranges::find(table, name, &StudyTableColumn::name);
}

StudyResult done(const StudyRow& row, double value) {
  StudyResult r;
  r.status = StudyResult::Status::done;
  r.values.assign(row.quantities.size(), value);
  r.mean = r.scatter = r.values;
  return r;
}

TEST(StudyTable, ParametersAreNumbersInOneUnitOrTextAsWritten) {
  const Study study = read_slab_study(R"(
quantities: [mass.initial / time.simulated]
tables:
  - name: a, "b"
    columns: [{set: continuum.cell}, {set: continuum.limiter}]
    rows: [[20 mm, minmod], [0.01, van_leer], [0.5 cm, mc]]
)");
  std::vector<StudyResult> results;
  for (const StudyRow& row : study.rows) results.push_back(done(row, 0.1 + 0.2));
  results[1].values[0] = std::nan("");
  results[2].reason = "two\nlines";
  const std::vector<StudyTableColumn> table = study_table(study, results);
  EXPECT_THAT(column(table, "continuum.cell").numbers, ElementsAre(20, 10, 5));
  EXPECT_EQ(column(table, "continuum.cell").unit, "mm");
  EXPECT_THAT(column(table, "continuum.limiter").texts, ElementsAre("minmod", "van_leer", "mc"));
  EXPECT_EQ(column(table, "mass.initial over time.simulated").unit, "kg/s");
  const std::string csv = study_csv(table);
  EXPECT_THAT(
      csv, StartsWith("table,variant,mode,seed,continuum.cell [mm],continuum.limiter,mass.initial over time.simulated [kg/s],"));
  EXPECT_NE(csv.find("\n\"a, \"\"b\"\"\",,continuum,,20,minmod,0.30000000000000004,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",10,van_leer,,"), std::string::npos) << "no value, no text: " << csv;
  EXPECT_NE(csv.find("\"two\nlines\""), std::string::npos);
}

TEST(StudyTable, KnowsWhatABareNumberCounts) {
  const Scene scaled = read_scene(COULOIR_SOURCE_DIR "/experiments/chiou_refinement", COULOIR_SOURCE_DIR "/dem_inputs/materials");
  EXPECT_EQ(unit_of_bare("continuum.cell", scaled).text, "33.33 mm");
  EXPECT_DOUBLE_EQ(unit_of_bare("obstacles.wall.size", scaled).si, 0.03333);
  EXPECT_EQ(unit_of_bare("continuum.refine[0].up", scaled).text, "33.33 mm");
  EXPECT_EQ(unit_of_bare("continuum.refine[0].levels", scaled).text, "");
  EXPECT_EQ(unit_of_bare("duration", scaled).text, "scale (2.47)");
  EXPECT_EQ(unit_of_bare("gravity", scaled).text, "m/s2");
  EXPECT_EQ(unit_of_path("gauges.a.max_speed / time.simulated").text, "(m/s)/s");
  EXPECT_EQ(unit_of_path("time.cpu / time.wall").text, "");
  EXPECT_EQ(unit_of_path("obstacles.wall.impulse / time.simulated").text, "N");
}

}  // namespace
}  // namespace couloir
