#include "coupling/check/expected.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "coupling/check/check_unit.hpp"
#include "coupling/check/expected_fields.hpp"
#include "coupling/scene/document.hpp"
#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> evidences{"exact", "seed table", "measured", "regression"};

// What cases and tables share, with what a table's rows are built on.
struct Setup {
  std::string name, scene, quick;  // quick: "", "skip", "only", "set"
  Overrides set, quick_set;
  std::optional<Search> search;
  std::vector<std::string> variants;  // in which it runs
};

// A column of a table: an override, or an expectation without its value.
struct Column {
  std::string key, form;  // override
  const Node* quantity = nullptr;
  std::vector<std::string> variants;
};

// Fills a form such as "[4, {}]".
std::string filled(const std::string& form, const std::string& text) {
  const auto at = form.find("{}");
  return at == std::string::npos ? text : form.substr(0, at) + text + form.substr(at + 2);
}

class Reader {
 public:
  Reader(const std::string& file, const CheckChoice& choice) : file_(file), choice_(choice) {}

  Expected read() {
    expected_.folder = fs::path(file_).parent_path().string();
    if (expected_.folder.empty()) expected_.folder = ".";
    const Node document = parse_document(read_document_text(file_), file_);
    const ExpectedFields top(document, "expected.yaml", {"scene", "variants", "cases", "tables"});
    scene_ = top.text("scene", "scene.yaml");
    read_variants(top.find("variants"));
    for (const Node& item : top.list("cases")) add_case(item);
    for (const Node& item : top.list("tables")) add_table(item);
    if (top.list("cases").empty() && top.list("tables").empty())
      throw SceneError(file_ + ":1: nothing is expected; give cases or tables");
    return std::move(expected_);
  }

 private:
  void read_variants(const Node* node) {
    if (!node) {
      variants_.emplace_back("", Overrides{});
      return;
    }
    if (node->kind != Node::Kind::mapping || node->entries.empty())
      throw SceneError(
          fmt::format("{}: variants is {}, but must be a mapping from names to overrides", node->place, describe(*node)));
    for (const auto& [name, entry] : node->entries) variants_.emplace_back(name, overrides(entry, "variants." + name));
  }

  Overrides overrides(const Node& node, const std::string& name) const {
    Overrides out;
    if (node.kind == Node::Kind::nothing) return out;
    if (node.kind != Node::Kind::mapping)
      throw SceneError(
          fmt::format("{}: {} is {}, but must be a mapping from the scene's keys to values", node.place, name, describe(node)));
    for (const auto& [key, value] : node.entries) out.emplace_back(key, override_text(value));
    return out;
  }

  // A list of variants' names; all where it is missing.
  std::vector<std::string> variant_list(const ExpectedFields& f, const std::string& key) const {
    std::vector<std::string> names, all;
    for (const auto& [name, set] : variants_) all.push_back(name);
    if (!f.find(key)) return all;
    for (const Node& item : f.list(key)) {
      refuse_unknown_variant(item, item.text);
      names.push_back(item.text);
    }
    return names;
  }

  void refuse_unknown_variant(const Node& at, const std::string& name) const {
    std::vector<std::string> all;
    for (const auto& [known, set] : variants_) all.push_back(known);
    if (std::ranges::count(all, name) > 0) return;
    const std::string known = all == std::vector<std::string>{""} ? ", which names none" : suggestion(name, all, "there are");
    throw SceneError(fmt::format("{}: '{}' is no variant of this file{}", at.place, name, known));
  }

  template <class F>
  auto quantity_of(const Node& node, const std::string& name, F&& parse) const {
    if (node.kind != Node::Kind::text)
      throw SceneError(
          fmt::format("{}: {} is {}, but must be a number, with a unit where it has one", node.place, name, describe(node)));
    try {
      return parse(node.text);
    } catch (const std::invalid_argument& error) {
      throw SceneError(fmt::format("{}: {} {}", node.place, name, error.what()));
    }
  }

  Setup setup(const ExpectedFields& f) {
    Setup out;
    out.name = f.text("name");
    if (out.name.empty()) f.fail(f.need("name"), "name", "is empty");
    out.scene = (fs::path(expected_.folder) / f.text("scene", scene_)).string();
    out.variants = variant_list(f, "variants");
    if (const Node* set = f.find("set")) out.set = overrides(*set, "set");
    if (const Node* quick = f.find("quick")) {
      if (quick->kind == Node::Kind::mapping) {
        out.quick = "set";
        out.quick_set = overrides(*quick, "quick");
      } else if (quick->kind == Node::Kind::text && (quick->text == "skip" || quick->text == "only")) {
        out.quick = quick->text;
      } else {
        f.fail(*quick, "quick", fmt::format("is {}, but must be skip, only, or a mapping of overrides", describe(*quick)));
      }
    }
    if (const Node* search = f.find("search")) out.search = read_search(*search);
    return out;
  }

  Search read_search(const Node& node) const {
    const ExpectedFields f(node, "a search", {"key", "value", "from", "to", "step", "quantity", "bound"});
    Search out;
    out.key = f.need("key").text;
    out.form = f.text("value", "{}");
    if (out.form.find("{}") == std::string::npos) f.fail(f.need("value"), "value", "needs {} where the number stands");
    const auto number = [&](const char* name) {
      const auto [value, unit] = quantity_of(f.need(name), name, parse_check_value);
      if (std::string(name) == "from") out.unit = unit.text;
      if (unit.text != out.unit) f.fail(f.need(name), name, "has another unit than from");
      return value;
    };
    out.from = number("from"), out.to = number("to"), out.step = number("step");
    if (!(out.step > 0) || !(out.to > out.from)) f.fail(f.need("step"), "step", "must be above 0, and from below to");
    out.quantity = f.need("quantity").text;
    std::tie(out.bound, out.bound_unit) = quantity_of(f.need("bound"), "bound", parse_check_value);
    require_unit(f.need("bound"), "bound", out.quantity, out.bound_unit);
    return out;
  }

  // A unit that cannot be that of the quantity is a slip of the pen.
  void require_unit(const Node& at, const std::string& name, const std::string& path, const CheckUnit& unit) const {
    if (path.find(" / ") != std::string::npos || path == "critical") return;
    const std::string wanted = quantity_of_path(path);
    if (wanted.empty() || unit.quantity == wanted || (wanted == "a plain number" && unit.quantity.empty())) return;
    throw SceneError(fmt::format("{}: {} {}, but {}is {}; write {}", at.place, name,
                                 unit.text.empty() ? "has no unit" : fmt::format("is in {}", unit.text),
                                 name == path ? "" : path + " ", wanted, fmt::join(units_of_quantity(wanted), ", ")));
  }

  Tolerance tolerance(const ExpectedFields& f, const std::string& variant, const CheckUnit& unit) const {
    const Node* node = &f.need("tolerance");
    if (node->kind == Node::Kind::mapping) {
      for (const auto& [name, entry] : node->entries) refuse_unknown_variant(entry, name);
      node = node->find(variant);
      if (!node) return {};
    }
    if (node->kind == Node::Kind::text && node->text == "none") return {};
    const auto [size, own] = quantity_of(*node, "tolerance", parse_check_value);
    if (!(size >= 0)) f.fail(*node, "tolerance", "must not be negative");
    if (own.text == "%") return {Tolerance::Kind::relative, size / 100};
    if (!own.text.empty() && own.quantity != unit.quantity)
      f.fail(*node, "tolerance", fmt::format("is '{}'; give % or the unit of the value, or none", node->text));
    return {Tolerance::Kind::absolute, own.text.empty() ? size : size * own.si / unit.si};
  }

  // `value` where it stands in a table's row; else the item's own.
  Expectation expectation(const Node& node, const std::string& variant, const Node* value, const std::string& evidence,
                          const std::string& source) const {
    const ExpectedFields f(node, "an expectation", {"quantity", "value", "unit", "tolerance", "evidence", "source", "variants"});
    Expectation out;
    out.quantity = f.need("quantity").text;
    const Node& given = value ? *value : f.need("value");
    std::tie(out.value, out.unit) = quantity_of(given, value ? out.quantity : "value", parse_check_value);
    if (const Node* unit = f.find("unit")) {
      if (!out.unit.text.empty()) f.fail(given, "value", "has a unit of its own beside the key unit; keep one of them");
      out.unit = quantity_of(*unit, "unit", parse_check_unit);
    }
    require_unit(given, out.quantity, out.quantity, out.unit);
    out.tolerance = tolerance(f, variant, out.unit);
    if (out.value == 0 && out.tolerance.kind == Tolerance::Kind::relative)
      throw SceneError(
          fmt::format("{}: {} is expected to be 0, of which every share is 0, but its tolerance is {:g} %; give a "
                      "number without %, in the unit of the value, or none",
                      given.place, out.quantity, 100 * out.tolerance.size));
    out.evidence = f.text("evidence", evidence);
    if (std::ranges::count(evidences, out.evidence) == 0) {
      const Node& at = f.find("evidence") ? f.need("evidence") : node;
      f.fail(at, "evidence", fmt::format("is '{}', but must be one of {}", out.evidence, fmt::join(evidences, ", ")));
    }
    out.source = f.text("source", source);
    if (out.source.empty()) f.fail(node, "source", "is missing: say where the expected value comes from");
    out.place = given.place;
    return out;
  }

  static bool holds(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::count(names, name) > 0;
  }

  // One case for each variant that is wanted.
  template <class Expect>
  void spread(const Setup& s, const Overrides& row, const std::string& row_name, const std::string& place, Expect&& expect) {
    for (const auto& [variant, set] : variants_) {
      if (!holds(s.variants, variant) || (!choice_.variants.empty() && !holds(choice_.variants, variant))) continue;
      if (s.quick == "only" && !choice_.quick) continue;
      CheckCase c;
      c.name = row_name.empty() ? s.name : s.name + ", " + row_name;
      c.variant = variant;
      c.scene = s.scene;
      c.place = place;
      c.search = s.search;
      c.skipped = choice_.quick && s.quick == "skip";
      for (const Overrides* part : {&set, &s.set, &row}) c.set.insert(c.set.end(), part->begin(), part->end());
      if (choice_.quick) c.set.insert(c.set.end(), s.quick_set.begin(), s.quick_set.end());
      expect(c);
      for (const Expectation& e : c.expect) {
        if (e.quantity == "critical" && !c.search) throw SceneError(e.place + ": quantity critical needs a search in its case");
        if (e.quantity != "critical" && c.search) throw SceneError(e.place + ": a case with a search has one quantity: critical");
      }
      if (!c.expect.empty()) expected_.cases.push_back(std::move(c));
    }
  }

  void add_case(const Node& node) {
    const ExpectedFields f(node, "a case",
                           {"name", "scene", "set", "quick", "search", "variants", "evidence", "source", "expect"});
    f.need("name"), f.need("expect");
    const std::string evidence = f.text("evidence"), source = f.text("source");
    spread(setup(f), {}, "", node.place, [&](CheckCase& c) {
      for (const Node& item : f.list("expect")) {
        const Node* own = item.find("variants");
        const ExpectedFields only(item, "an expectation",
                                  {"quantity", "value", "unit", "tolerance", "evidence", "source", "variants"});
        if (own && !holds(variant_list(only, "variants"), c.variant)) continue;
        c.expect.push_back(expectation(item, c.variant, nullptr, evidence, source));
      }
    });
  }

  std::vector<Column> columns(const ExpectedFields& table) const {
    std::vector<Column> out;
    for (const Node& item : table.list("columns")) {
      Column column;
      if (item.find("set")) {
        const ExpectedFields f(item, "a column", {"set", "value"});
        column.key = f.text("set");
        column.form = f.text("value", "{}");
      } else {
        const ExpectedFields f(item, "a column", {"quantity", "unit", "tolerance", "evidence", "source", "variants"});
        f.need("quantity");
        column.quantity = &item;
        column.variants = variant_list(f, "variants");
      }
      out.push_back(column);
    }
    return out;
  }

  // A cell is a value, or a mapping with a value and what differs from its column.
  Expectation table_cell(const Node& column, const Node& cell, const std::string& variant, const std::string& evidence,
                         const std::string& source) const {
    if (cell.kind != Node::Kind::mapping) return expectation(column, variant, &cell, evidence, source);
    const ExpectedFields f(cell, "a cell", {"value", "tolerance", "evidence", "source"});
    Node merged = column;
    for (const auto& [name, entry] : cell.entries)
      if (name != "value") merged.entry(name) = entry;
    return expectation(merged, variant, &f.need("value"), evidence, source);
  }

  void add_table(const Node& node) {
    const ExpectedFields f(node, "a table",
                           {"name", "scene", "set", "quick", "search", "variants", "evidence", "source", "columns", "rows"});
    f.need("name"), f.need("columns"), f.need("rows");
    const std::vector<Column> heads = columns(f);
    const Setup shared = setup(f);
    int number = 0;
    for (const Node& row : f.list("rows")) {
      ++number;
      if (row.kind != Node::Kind::list || row.items.size() != heads.size())
        throw SceneError(fmt::format("{}: a row is a list with a value for each of the {} columns", row.place, heads.size()));
      Overrides set;
      std::vector<std::string> words;
      for (std::size_t k = 0; k < heads.size(); ++k) {
        if (heads[k].key.empty()) continue;
        const std::string text = override_text(row.items[k]);
        set.emplace_back(heads[k].key, filled(heads[k].form, text));
        words.push_back(text);
      }
      const std::string source = f.text("source").empty() ? "" : fmt::format("{} row {}", f.text("source"), number);
      spread(shared, set, fmt::format("{}", fmt::join(words, " / ")), row.place, [&](CheckCase& c) {
        for (std::size_t k = 0; k < heads.size(); ++k) {
          const Node& cell = row.items[k];
          if (!heads[k].quantity || !holds(heads[k].variants, c.variant) || cell.kind == Node::Kind::nothing) continue;
          c.expect.push_back(table_cell(*heads[k].quantity, cell, c.variant, f.text("evidence"), source));
        }
      });
    }
  }

  const std::string& file_;
  const CheckChoice& choice_;
  std::string scene_;
  std::vector<std::pair<std::string, Overrides>> variants_;
  Expected expected_;
};

}  // namespace

Expected read_expected(const std::string& file, const CheckChoice& choice) {
  return Reader(file, choice).read();
}

std::vector<std::string> find_expected(const std::vector<std::string>& paths) {
  std::vector<std::string> found;
  for (const std::string& path : paths) {
    std::error_code error;
    std::vector<std::string> here;
    if (!fs::exists(path, error)) throw SceneError(path + ": there is no such file or folder; give an experiment's folder");
    if (!fs::is_directory(path, error)) {
      here.push_back(path);
    } else if (fs::exists(fs::path(path) / "expected.yaml", error)) {
      here.push_back((fs::path(path) / "expected.yaml").string());
    } else {
      for (const auto& entry : fs::recursive_directory_iterator(path, error))
        if (entry.path().filename() == "expected.yaml") here.push_back(entry.path().string());
      std::ranges::sort(here);
    }
    if (here.empty()) throw SceneError(path + " holds no expected.yaml; give an experiment's folder, or a folder of those");
    for (std::string& file : here)
      if (std::ranges::count(found, file) == 0) found.push_back(std::move(file));
  }
  return found;
}

}  // namespace couloir
