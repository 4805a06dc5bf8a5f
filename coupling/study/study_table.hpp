#pragma once
// The table of a study: a row for each of its rows, columns that say what they are. The same numbers as CSV, HDF5 and JSON.
//
//   study.csv   a header "name [unit]", then the rows; empty: no value
//   study.h5    /rows/<name>, one dataset a column, with unit, description, role and label; NaN: no value
//               attributes: format, title, study (the file's text), columns (their names in order), revision, status, total_cpu
//               (of all runs, each once) ...; and /ladder, the text of ladder.json, where the study has one

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupling/study/study_run.hpp"

namespace couloir {

struct StudyTableColumn {
  std::string name, unit, description;
  std::string role;   // label | parameter | quantity | mean | scatter | reference | cost | record
  std::string label;  // for pictures
  bool text = false;
  std::vector<double> numbers;  // one of the two
  std::vector<std::string> texts;
};

// A parameter that is called as a quantity or another column has " set" behind its name.
std::vector<StudyTableColumn> study_table(const Study&, const std::vector<StudyResult>&);

std::string study_csv(const std::vector<StudyTableColumn>&);
nlohmann::ordered_json study_json(const std::vector<StudyTableColumn>&);  // a list of rows, by the columns' names
// Under its final name or not at all. Throws RecordError.
void write_study_h5(const std::string& path, const Study&, const std::string& status, const std::vector<StudyResult>&);

}  // namespace couloir
