#pragma once
// study.yaml as plain data: which runs to make, and what of them goes into the table. docs/studies.md tells the format.
//
//   study.yaml -> Study: a table of rows, each a run or a search, spelt out over parameters, variants, modes and seeds

#include <string>
#include <utility>
#include <vector>

#include "coupling/cases/case_reader.hpp"
#include "coupling/cases/case_run.hpp"

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
  double planned = 0;  // [s] of one core, by the plan; a search: as many runs as it may need
};

struct Study {
  std::string name, title, text;  // name: the experiment's folder; text: study.yaml as it stands
  std::vector<StudyParameter> parameters;
  std::vector<StudyQuantity> quantities;  // of all tables; in each once
  std::vector<StudyRow> rows;
};

// Reads every scene and holds the quantities against what its summary will have, so that a mistake comes before any run. Throws
// SceneError with file, line, key and the nearest right name.
Study read_study(const std::string& file, const CaseChoice&, const std::string& materials);

}  // namespace couloir
