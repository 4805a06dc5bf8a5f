#pragma once
// expected.yaml as plain data: what an experiment is expected to show. docs/experiments.md tells the format.
//
//   expected.yaml -> Expected: cases, each a scene with overrides and what is expected of its summary
//
// Tables are spelt out into cases, and cases into one for each of their variants.

#include <optional>
#include <string>
#include <vector>

#include "coupling/scene/reader.hpp"

namespace couloir {

// How far a value may be from what is expected.
struct Tolerance {
  enum class Kind { none, relative, absolute } kind = Kind::none;  // none: shown only
  double size = 0;                                                 // relative [-]; absolute: in the expectation's unit
};

// A unit is a number times a unit's name: "N", "33.33 mm", "%". Values are multiples of it.
struct CheckUnit {
  std::string text;      // as written; empty: a plain number
  std::string quantity;  // "a force"; empty: any
  double si = 1;         // one of it in SI
};

struct Expectation {
  std::string quantity;  // a path into summary.json, a ratio of two, or `critical`
  double value = 0;      // in the unit
  CheckUnit unit;
  Tolerance tolerance;
  std::string evidence;  // exact | seed table | measured | regression
  std::string source;    // "Table 7.1 row 3"
  std::string place;     // "expected.yaml:14"
};

// The smallest value of a key for which a quantity stays at or below a bound. The quantity must fall as the value rises.
struct Search {
  std::string key, form;  // override; form: the value's text, {} stands for the number
  double from = 0, to = 0, step = 0;
  std::string unit;      // written after the number; empty: a bare number
  std::string quantity;  // path into summary.json
  double bound = 0;      // in bound_unit
  CheckUnit bound_unit;
};

struct CheckCase {
  std::string name, variant;  // variant empty: the file has none
  std::string scene;          // path of the scene file
  Overrides set;              // in this order: the variant's, the table's or case's, the row's, quick's
  std::optional<Search> search;
  std::vector<Expectation> expect;
  std::string place;
  bool skipped = false;
};

struct Expected {
  std::string folder;  // of the experiment
  std::vector<CheckCase> cases;
};

struct CheckChoice {
  bool quick = false;
  std::vector<std::string> variants;  // empty: all
};

// Throws SceneError with file, line, key and the nearest right name.
Expected read_expected(const std::string& file, const CheckChoice& = {});

// All expected.yaml under the paths given (files, experiments' folders, or folders of those), in alphabetical order. Throws
// SceneError where there is none.
std::vector<std::string> find_expected(const std::vector<std::string>& paths);

}  // namespace couloir
