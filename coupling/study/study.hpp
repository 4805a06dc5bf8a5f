#pragma once
// study.yaml as plain data: which runs to make, and what of them goes into the table. docs/studies.md tells the format.
//
//   study.yaml -> Study: a table of rows, each a run or a search, spelt out over parameters, variants, modes and seeds

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/cases/case_reader.hpp"
#include "coupling/cases/case_run.hpp"
#include "coupling/study/likeness.hpp"

namespace couloir {

// What a row shows of its run.
struct StudyQuantity {
  std::string path;   // into summary.json, a ratio of two, or `critical`
  std::string label;  // for pictures
  CaseUnit unit;      // in which it is shown
};

// A key that rows set.
struct StudyParameter {
  std::string key;    // as after --set
  std::string label;  // for pictures
};

struct StudyReference {
  double value = 0;    // in the unit of the quantity of the same path; NaN: none
  std::string source;  // where it stands
};

struct StudyRow : CaseRun {  // overrides: mode, variant, table, parameters, quick, seed
  std::string table, mode;
  long seed = 0;                                                   // of the grains; 0: a row without grains
  int group = 0;                                                   // rows that differ in the seed alone have the same
  std::vector<std::pair<std::string, std::string>> parameters;     // key, value as written
  std::vector<std::pair<std::string, CaseUnit>> units;             // of those that are bare numbers
  std::vector<StudyQuantity> quantities;                           // that the row's table asks for
  std::vector<std::pair<std::string, StudyReference>> references;  // by a quantity's path
  int rung = -1;                                                   // of the ladder; -1: of a table
  std::optional<nlohmann::json> known;                             // the summary, where nothing is to be run: a mass point's
  double planned = 0;  // [s] of one core, by the plan; a search: as many runs as it may need
};

// One model of the scene with its settings.
struct Rung {
  std::string name, mode;     // a scene's mode, or "mass point"
  Overrides set;              // of its own, without mode and seed
  double cells_in_depth = 0;  // depth of the flow before the obstacle over the cells' length; NaN: there are none
  double grains_in_depth = 0;
  double planned = 0;  // [s] of one core and run, by the plan
};

// ladder.hpp tells what is made of it.
struct Ladder {
  std::vector<StudyQuantity> quantities;
  std::vector<Rung> rungs;
  int reference = -1;                  // a rung; -1: the values below
  std::vector<StudyReference> values;  // as quantities, in their units
  std::vector<double> errors{0.2, 0.1, 0.05};
  Likeness scene;  // of the scene without what rungs set
};

struct Study {
  std::string name, title, text;  // name: the experiment's folder, and the file's name but for study.yaml; text: the file
  std::vector<StudyParameter> parameters;
  std::vector<StudyQuantity> quantities;  // of all tables; in each once
  std::vector<StudyRow> rows;
  std::optional<Ladder> ladder;
};

// Reads every scene and holds the quantities against what its summary will have, so that a mistake comes before any run. Throws
// SceneError with file, line, key and the nearest right name.
Study read_study(const std::string& file, const CaseChoice&, const std::string& materials);

}  // namespace couloir
