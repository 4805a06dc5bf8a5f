#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <optional>

#include "coupling/cases/summary_value.hpp"
#include "coupling/plan/limits.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/scene/document.hpp"
#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/study/blank_summary.hpp"
#include "coupling/study/ladder_reader.hpp"
#include "coupling/study/mass_point_run.hpp"
#include "coupling/study/study.hpp"
#include "coupling/study/study_columns.hpp"
#include "coupling/study/study_unit.hpp"

namespace couloir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr long most_replicates = 1000;
constexpr long most_rows = 100000;

// Grain seeds: a number of them, from the scene's own upward, or the seeds themselves.
struct Replicates {
  long count = 1;
  std::vector<long> seeds;
  const Node* node = nullptr;
};

struct PlacedQuantity {
  StudyQuantity quantity;
  const Node* node;
  bool unit_given;
};

// What the file gives for all tables and a table may give anew.
struct Shared {
  std::vector<std::string> modes;  // empty: the scene's own
  Replicates replicates;
  std::vector<PlacedQuantity> quantities;
};

// Whether `key` is `other` or lies in it.
bool under(const std::string& key, const std::string& other) {
  return key.starts_with(other) && (key.size() == other.size() || key[other.size()] == '.' || key[other.size()] == '[');
}

class Reader : CaseReader {
 public:
  Reader(const std::string& file, const CaseChoice& choice, const std::string& materials)
      : CaseReader(file, choice), materials_(materials) {}

  Study read() {
    const std::string stem = std::filesystem::path(file()).stem().string();
    study_.name = experiment_name(folder()) + (stem == "study" ? "" : "-" + stem);
    study_.text = read_document_text(file());
    const Node document = parse_document(study_.text, file());
    const CaseFields top(document, "study.yaml",
                         {"title", "scene", "variants", "modes", "replicates", "quantities", "tables", "ladder"});
    study_.title = top.text("title", study_.name);
    read_top(top);
    const Shared shared = read_shared(top, {});
    const Node* ladder = top.find("ladder");
    if (top.list("tables").empty() && !ladder) throw SceneError(file() + ":1: there is nothing to run; give tables, or a ladder");
    for (const Node& item : top.list("tables")) add_table(item, shared);
    if (ladder && top.find("variants"))
      throw SceneError(ladder->place + ": a ladder stands in a file without variants; write what they set into its rungs");
    if (ladder) add_ladder(*ladder, shared);
    if (study_.rows.empty())
      throw SceneError(file() + ": there is nothing to run: no table is left; give another --variant, or leave out --quick");
    return std::move(study_);
  }

 private:
  static long integer(const Node& node, const std::string& name, long least, long most) {
    long value = 0;
    const char* end = node.text.data() + node.text.size();
    const auto [at, error] = std::from_chars(node.text.data(), end, value);
    if (node.kind != Node::Kind::text || error != std::errc() || at != end || value < least || value > most)
      throw SceneError(
          fmt::format("{}: {} is {}, but must be a whole number from {} to {}", node.place, name, describe(node), least, most));
    return value;
  }

  Shared read_shared(const CaseFields& f, Shared out) const {
    const std::vector<std::string> modes{to_string(Mode::continuum), to_string(Mode::coupled), to_string(Mode::grains)};
    if (f.find("modes")) out.modes.clear();
    for (const Node& item : f.list("modes")) {
      if (!holds(modes, item.text))
        throw SceneError(
            fmt::format("{}: modes: '{}' is none{}", item.place, item.text, suggestion(item.text, modes, "there are")));
      out.modes.push_back(item.text);
    }
    if (const Node* node = f.find("modes"); node && out.modes.empty())
      throw SceneError(node->place + ": modes names none; leave it out for the scene's own");
    if (const Node* node = f.find("replicates")) {
      out.replicates = {};
      out.replicates.node = node;
      if (node->kind == Node::Kind::list) {
        for (const Node& item : node->items)
          out.replicates.seeds.push_back(integer(item, "replicates", 1, std::numeric_limits<std::int32_t>::max()));
        if (node->items.empty()) f.fail(*node, "replicates", "is empty; give seeds, or how many");
      } else {
        out.replicates.count = integer(*node, "replicates", 1, most_replicates);
      }
    }
    if (f.find("quantities")) out.quantities.clear();
    for (const Node& item : f.list("quantities")) out.quantities.push_back(quantity(item));
    return out;
  }

  PlacedQuantity quantity(const Node& node) const {
    if (node.kind == Node::Kind::text) return {{node.text, node.text, unit_of_path(node.text)}, &node, false};
    const CaseFields f(node, "a quantity", {"quantity", "unit", "name"});
    StudyQuantity out;
    out.path = f.need("quantity").text;
    out.label = f.text("name", out.path);
    const Node* unit = f.find("unit");
    out.unit = unit ? parsed(*unit, "unit", parse_case_unit) : unit_of_path(out.path);
    if (unit) require_unit(*unit, "unit", out.path, out.unit);
    return {out, &node, unit != nullptr};
  }

  // The table's quantities; a search has its critical value first.
  std::vector<PlacedQuantity> quantities_of(const CaseSetup& s, const Shared& shared, const CaseFields& f) const {
    std::vector<PlacedQuantity> out = shared.quantities;
    const auto critical = [](const PlacedQuantity& q) { return q.quantity.path == "critical"; };
    const auto at = std::ranges::find_if(out, critical);
    if (!s.search && at != out.end()) {
      if (f.find("quantities")) throw SceneError(at->node->place + ": quantity critical needs a search in its table");
      out.erase(at);
    }
    if (s.search && at == out.end())
      out.insert(out.begin(), {{"critical", "critical " + s.search->key, {}}, &f.need("search"), false});
    if (out.empty()) f.fail(f.need("name"), "quantities", "are missing: say what the rows show, in the table or in the file");
    return out;
  }

  void refuse_clashes(const CaseSetup& s, const std::vector<StudyColumn>& columns, const Shared& shared) const {
    for (const StudyColumn& c : columns) {
      if (c.key.empty()) continue;
      const auto refuse = [&](const std::string& what) {
        throw SceneError(fmt::format("{}: {} is a column of this table, but {}", c.node->place, c.key, what));
      };
      for (const auto& [key, value] : s.quick_set)
        if (under(key, c.key) || under(c.key, key)) refuse("quick sets " + key + "; write a table of its own with quick: only");
      for (const auto& [key, value] : command_line())
        if (under(key, c.key) || under(c.key, key)) refuse("--set gives " + key + "; choose another key, or another study");
      if (s.search && under(c.key, s.search->key)) refuse("the search looks for it; keep one of them");
      if (c.key == "mode" && !shared.modes.empty()) refuse("there are modes; keep one of them");
      if (c.key == "grains.seed" && shared.replicates.node) refuse("there are replicates; keep one of them");
    }
  }

  void add_table(const Node& node, const Shared& of_file) {
    const CaseFields f(
        node, "a table",
        {"name", "scene", "set", "quick", "search", "variants", "modes", "replicates", "quantities", "columns", "rows"});
    f.need("name");
    const CaseSetup s = setup(f, f.list("rows").size());
    const Shared shared = read_shared(f, of_file);
    const std::vector<StudyColumn> columns = study_columns(f);
    refuse_clashes(s, columns, shared);
    const std::vector<PlacedQuantity> quantities = quantities_of(s, shared, f);
    const std::vector<StudyCells> cells = study_cells(f, columns, node.place);
    if (quick() && s.quick == "skip") return;
    for (const StudyColumn& c : columns)
      if (!c.key.empty() && std::ranges::count(study_.parameters, c.key, &StudyParameter::key) == 0)
        study_.parameters.push_back({c.key, c.label});
    std::vector<std::string> modes = shared.modes;
    if (modes.empty()) modes.emplace_back();
    for (const auto& [variant, set] : variants()) {
      if (!wanted(s, variant)) continue;
      for (const std::string& mode : modes) {
        for (std::size_t k = 0; k < cells.size(); ++k) {
          if (skipped(s, static_cast<int>(k) + 1)) continue;
          const StudyCells& c = cells[k];
          StudyRow row;
          row.table = s.name, row.variant = variant, row.mode = mode;
          row.name = c.name.empty() ? s.name : s.name + ", " + c.name;
          row.scene = s.scene, row.search = s.search, row.place = c.place;
          row.parameters = c.parameters;
          if (!mode.empty()) row.set.emplace_back("mode", mode);
          for (const Overrides& part : {set, s.set, c.set, last_overrides(s)})
            row.set.insert(row.set.end(), part.begin(), part.end());
          add_group(std::move(row), c, quantities, shared.replicates);
        }
      }
    }
  }

  // One row, or with grains one for each seed.
  void add_group(StudyRow row, const StudyCells& cells, const std::vector<PlacedQuantity>& quantities,
                 const Replicates& replicates) {
    const Scene scene = scenes_of(row, materials_).back();
    row.mode = to_string(scene.mode);
    row.group = study_.rows.empty() ? 0 : study_.rows.back().group + 1;
    for (const auto& [key, text] : row.parameters) row.units.emplace_back(key, unit_of_bare(key, scene));
    add_quantities(row, scene, quantities);
    for (const auto& [column, cell] : cells.references) add_reference(row, *column, *cell);
    row.planned = planned_time(row, scene) * (row.search ? row.search->most_runs() : 1);
    std::vector<long> seeds = replicates.seeds;
    if (seeds.empty())
      for (long k = 0; k < replicates.count; ++k) seeds.push_back(scene.grains.seed + k);
    if (scene.mode == Mode::continuum) seeds = {0};  // nothing in it is random
    for (const long seed : seeds) {
      StudyRow& one = study_.rows.emplace_back(row);
      one.seed = seed;
      if (seed != 0) one.set.emplace_back("grains.seed", std::to_string(seed));
      if (seed != 0 && scene.grains.replicates > 1) one.set.emplace_back("grains.replicates", "1");  // each row is one run
    }
    if (study_.rows.size() > most_rows)
      throw SceneError(fmt::format("{}: these are more than {} rows; leave some values out", cells.place, most_rows));
  }

  void add_ladder(const Node& node, const Shared& of_file) {
    const LadderNode given(node, *this);
    const Shared shared = read_shared(given.fields, of_file);
    Ladder& ladder = study_.ladder.emplace();
    if (!given.errors.empty()) ladder.errors = given.errors;
    const std::size_t before = study_.rows.size();
    for (const LadderRung& rung : given.rungs) {
      const std::size_t first = study_.rows.size();
      add_table(rung.table, shared);
      if (study_.rows.size() == first) continue;  // left out by --quick
      add_rung(rung, first);
    }
    if (study_.rows.size() == before)
      throw SceneError(node.place + ": no rung is left; leave out --quick, or give some of them other words for it");
    ladder.quantities = study_.rows[before].quantities;
    const auto own = std::ranges::find(ladder.rungs, given.reference, &Rung::name);
    if (!given.reference.empty() && own == ladder.rungs.end())
      throw SceneError(fmt::format("{}: the reference, '{}', is left out by --quick; give it what it shall set then",
                                   given.fields.need("reference").place, given.reference));
    if (!given.reference.empty()) ladder.reference = static_cast<int>(own - ladder.rungs.begin());
    if (!given.reference.empty() && ladder.rungs[static_cast<std::size_t>(ladder.reference)].mode == mass_point_mode)
      throw SceneError(given.fields.need("reference").place +
                       ": a mass point is no reference; take grains, or a value with its source");
    for (const StudyQuantity& q : ladder.quantities) {
      if (!given.reference.empty()) break;
      const auto value = std::ranges::find(given.values, q.path, &LadderValue::path);
      if (value == given.values.end())
        throw SceneError(fmt::format("{}: reference: there is no value for {}", given.fields.need("reference").place, q.path));
      ladder.values.push_back({in_unit_of(q, value->value, value->unit, value->node->place), value->source});
    }
    CaseRun base;
    base.name = "ladder", base.scene = study_.rows[before].scene, base.place = node.place;
    if (const Node* set = given.fields.find("set")) base.set = overrides(*set, "set");
    base.set.insert(base.set.end(), command_line().begin(), command_line().end());
    ladder.scene = likeness(scenes_of(base, materials_).back());
  }

  // The rows from `first` on, as one of the ladder.
  void add_rung(const LadderRung& given, std::size_t first) {
    StudyRow& row = study_.rows[first];
    const Scene scene = scenes_of(row, materials_).back();
    Rung rung{given.name, row.mode, {}, nan, nan, row.planned};
    if (const Node* set = given.node->find("set")) rung.set = overrides(*set, "set");
    if (given.mode == mass_point_mode) {
      study_.rows.resize(first + 1);  // nothing in it is random
      rung.mode = row.mode = mass_point_mode;
      row.seed = 0, row.planned = rung.planned = 0;
      std::erase_if(row.set, [](const auto& one) { return one.first == "grains.seed"; });
      row.known = mass_point_summary(scene);
    } else {
      if (scene.mode != Mode::grains) rung.cells_in_depth = depth_before(scene) / scene.continuum.cell;
      if (scene.mode != Mode::continuum) rung.grains_in_depth = depth_before(scene) / scene.grains.diameter;
    }
    for (std::size_t k = first; k < study_.rows.size(); ++k) {
      study_.rows[k].table = "ladder";
      study_.rows[k].rung = static_cast<int>(study_.ladder->rungs.size());
    }
    study_.ladder->rungs.push_back(rung);
  }

  static double planned_time(const StudyRow& row, const Scene& scene) {
    try {
      const Plan plan = make_plan(scene);
      check_memory(scene, plan);
      return plan.time;
    } catch (const SceneError& error) {
      throw SceneError(fmt::format("{}: {}: {}", row.place, row.name, error.what()));
    }
  }

  void add_quantities(StudyRow& row, const Scene& scene, const std::vector<PlacedQuantity>& quantities) {
    const nlohmann::json blank = blank_summary(scene);
    if (row.search) summary_value(blank, row.search->quantity, row.place);
    for (PlacedQuantity q : quantities) {
      if (q.quantity.path != "critical") {
        summary_value(blank, q.quantity.path, q.node->place);
      } else if (!q.unit_given) {
        q.quantity.unit = row.search->unit.empty() ? unit_of_bare(row.search->key, scene) : parse_case_unit(row.search->unit);
      }
      row.quantities.push_back(q.quantity);
      const auto known = std::ranges::find(study_.quantities, q.quantity.path, &StudyQuantity::path);
      if (known == study_.quantities.end()) {
        study_.quantities.push_back(q.quantity);
      } else if (known->unit.text != q.quantity.unit.text) {
        throw SceneError(fmt::format("{}: {} is in '{}' here, but in '{}' before; a column of the table has one unit",
                                     q.node->place, known->path, q.quantity.unit.text, known->unit.text));
      }
    }
  }

  void add_reference(StudyRow& row, const StudyColumn& column, const Node& cell) const {
    const auto q = std::ranges::find(row.quantities, column.reference, &StudyQuantity::path);
    if (q == row.quantities.end()) {
      std::vector<std::string> paths;
      for (const StudyQuantity& known : row.quantities) paths.push_back(known.path);
      throw SceneError(fmt::format("{}: reference: {} is no quantity of this table{}", column.node->place, column.reference,
                                   suggestion(column.reference, paths, "there are")));
    }
    auto [value, unit] = parsed(cell, column.reference, parse_case_value);
    if (unit.text.empty() && !column.unit.empty()) unit = parsed(*column.node->find("unit"), "unit", parse_case_unit);
    row.references.emplace_back(column.reference, StudyReference{in_unit_of(*q, value, unit, cell.place), column.source});
  }

  // A reference's value, which may have another unit than the quantity is shown in.
  static double in_unit_of(const StudyQuantity& q, double value, const CaseUnit& unit, const std::string& place) {
    if (unit.text.empty()) return value;
    if (unit.quantity != q.unit.quantity)
      throw SceneError(fmt::format("{}: the reference is in {}, but {} in {}", place, unit.text, q.path,
                                   q.unit.text.empty() ? "no unit" : q.unit.text));
    return value * unit.si / q.unit.si;
  }

  std::string materials_;
  Study study_;
};

}  // namespace

Study read_study(const std::string& file, const CaseChoice& choice, const std::string& materials) {
  return Reader(file, choice, materials).read();
}

}  // namespace couloir
