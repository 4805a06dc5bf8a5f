#pragma once
// What expected.yaml and study.yaml share: variants, overrides, quick, searches, values with units. docs/experiments.md tells
// the words. Every function throws SceneError with file, line, key and the nearest right name.

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "coupling/cases/case_fields.hpp"
#include "coupling/cases/case_unit.hpp"
#include "coupling/cases/search.hpp"

namespace couloir {

// What the command line leaves of a file's cases.
struct CaseChoice {
  bool quick = false;
  std::vector<std::string> variants;  // empty: all
  Overrides set;                      // of every case, after all that its file sets
};

// What cases and tables have in common.
struct CaseSetup {
  std::string name, scene;      // scene: path of its file
  std::string quick;            // "", "skip", "only", "set", "rows"
  std::vector<int> quick_rows;  // of a table, from 1
  Overrides set, quick_set;
  std::optional<Search> search;
  std::vector<std::string> variants;  // in which it runs
};

class CaseReader {
 public:
  CaseReader(const std::string& file, const CaseChoice& choice);

  const std::string& file() const { return file_; }
  const std::string& folder() const { return folder_; }  // of the file
  bool quick() const { return choice_.quick; }
  const Overrides& command_line() const { return choice_.set; }

  // The file's keys `scene` and `variants`.
  void read_top(const CaseFields&);
  const std::vector<std::pair<std::string, Overrides>>& variants() const { return variants_; }
  // Whether a setup is asked for: in this variant, and with or without --quick.
  bool wanted(const CaseSetup&, const std::string& variant) const;
  // Whether --quick leaves it out; `row` of a table, from 1.
  bool skipped(const CaseSetup&, int row) const;

  // `rows`: how many a table has, 0 of a case.
  CaseSetup setup(const CaseFields&, std::size_t rows = 0) const;
  // What is set last: with --quick the setup's own for it, then the command line's.
  Overrides last_overrides(const CaseSetup&) const;
  Overrides overrides(const Node&, const std::string& name) const;
  // A list of variants' names; all where the key is missing.
  std::vector<std::string> variant_list(const CaseFields&, const std::string& key) const;
  void refuse_unknown_variant(const Node& at, const std::string& name) const;
  // A unit that cannot be that of the quantity is a slip of the pen.
  void require_unit(const Node& at, const std::string& name, const std::string& path, const CaseUnit&) const;

  // A text that `parse` understands; it throws std::invalid_argument where it does not.
  template <class F>
  auto parsed(const Node& node, const std::string& name, F&& parse) const {
    require_text(node, name);
    try {
      return parse(node.text);
    } catch (const std::invalid_argument& error) {
      throw_wrong(node, name, error.what());
    }
  }

 private:
  void read_quick(const CaseFields&, std::size_t rows, CaseSetup&) const;
  Search read_search(const Node&) const;
  void require_text(const Node&, const std::string& name) const;
  [[noreturn]] void throw_wrong(const Node&, const std::string& name, const std::string& what) const;

  std::string file_, folder_, scene_;
  CaseChoice choice_;
  std::vector<std::pair<std::string, Overrides>> variants_;  // a file without any has one without a name
};

// Whether a list holds a name.
bool holds(const std::vector<std::string>& names, const std::string& name);

// All files of this name under the paths given (files, experiments' folders, or folders of those), in alphabetical order. Throws
// SceneError where there is none.
std::vector<std::string> find_case_files(const std::vector<std::string>& paths, const std::string& name);

// "wedge_force" for experiments/wedge_force.
std::string experiment_name(const std::string& folder);

}  // namespace couloir
