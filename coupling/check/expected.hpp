#pragma once
// expected.yaml as plain data: what an experiment is expected to show. docs/experiments.md tells the format.
//
//   expected.yaml -> Expected: cases, each a scene with overrides and what is expected of its summary
//
// Tables are spelt out into cases, and cases into one for each of their variants.

#include <string>
#include <vector>

#include "coupling/cases/case_reader.hpp"
#include "coupling/cases/case_run.hpp"

namespace couloir {

// How far a value may be from what is expected.
struct Tolerance {
  enum class Kind { none, relative, absolute } kind = Kind::none;  // none: shown only
  double size = 0;                                                 // relative [-]; absolute: in the expectation's unit
};

struct Expectation {
  std::string quantity;  // a path into summary.json, a ratio of two, or `critical`
  double value = 0;      // in the unit
  CaseUnit unit;
  Tolerance tolerance;
  std::string evidence;  // exact | seed table | measured | regression
  std::string source;    // "Table 7.1 row 3"
  std::string place;     // "expected.yaml:14"
};

struct CheckCase : CaseRun {  // overrides in this order: the variant's, the table's or case's, the row's, quick's
  std::vector<Expectation> expect;
  bool skipped = false;
};

struct Expected {
  std::string folder;  // of the experiment
  std::vector<CheckCase> cases;
};

// Throws SceneError with file, line, key and the nearest right name.
Expected read_expected(const std::string& file, const CaseChoice& = {});

}  // namespace couloir
