#pragma once
// The key `ladder` of study.yaml, taken apart: its rungs as tables of one row, and what their errors are measured against.

#include <string>
#include <vector>

#include "coupling/cases/case_reader.hpp"
#include "coupling/study/study.hpp"

namespace couloir {

inline constexpr const char* mass_point_mode = "mass point";

struct LadderRung {
  std::string name, mode;  // mode empty: the scene's own
  Node table;              // as one of `tables`
  const Node* node = nullptr;
};

struct LadderValue {
  std::string path, source;
  double value = 0;
  CaseUnit unit;
  const Node* node = nullptr;
};

struct LadderNode {
  explicit LadderNode(const Node& node, const CaseReader&);  // throws SceneError
  CaseFields fields;
  std::vector<LadderRung> rungs;
  std::string reference;  // a rung's name; empty: values
  std::vector<LadderValue> values;
  std::vector<double> errors;  // empty: not given
};

}  // namespace couloir
