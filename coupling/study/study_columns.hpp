#pragma once
// The columns of a table of study.yaml, and its rows spelt out: each cell beside each, or every combination of the columns'
// values.

#include <string>
#include <utility>
#include <vector>

#include "coupling/cases/case_fields.hpp"
#include "coupling/cases/case_unit.hpp"

namespace couloir {

struct StudyColumn {
  std::string key, form, label;  // an override; form: the value's text, {} stands for the cell
  std::string reference;         // or the path of the quantity whose reference values stand here
  std::string unit, source;      // of a reference
  const Node* node = nullptr;
};

struct StudyCells {
  std::vector<std::pair<std::string, std::string>> parameters;  // key, cell
  std::vector<std::pair<std::string, std::string>> set;         // key, the cell in its form
  std::vector<std::pair<const StudyColumn*, const Node*>> references;
  std::string name;  // "0.1 / 0.2"
  std::string place;
};

// `table` has the keys columns and rows. Throws SceneError with file, line and key.
std::vector<StudyColumn> study_columns(const CaseFields& table);
std::vector<StudyCells> study_cells(const CaseFields& table, const std::vector<StudyColumn>&, const std::string& place);

}  // namespace couloir
