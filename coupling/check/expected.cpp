#include "coupling/check/expected.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "coupling/cases/case_fields.hpp"
#include "coupling/cases/case_unit.hpp"
#include "coupling/scene/document.hpp"
#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> evidences{"exact", "seed table", "measured", "regression"};

// A column of a table: an override, or an expectation without its value.
struct Column {
  std::string key, form;  // override
  const Node* quantity = nullptr;
  std::vector<std::string> variants;
};

class Reader : CaseReader {
 public:
  using CaseReader::CaseReader;

  Expected read() {
    expected_.folder = folder();
    const Node document = parse_document(read_document_text(file()), file());
    const CaseFields top(document, "expected.yaml", {"scene", "variants", "cases", "tables"});
    read_top(top);
    for (const Node& item : top.list("cases")) add_case(item);
    for (const Node& item : top.list("tables")) add_table(item);
    if (top.list("cases").empty() && top.list("tables").empty())
      throw SceneError(file() + ":1: nothing is expected; give cases or tables");
    return std::move(expected_);
  }

 private:
  Tolerance tolerance(const CaseFields& f, const std::string& variant, const CaseUnit& unit) const {
    const Node* node = &f.need("tolerance");
    if (node->kind == Node::Kind::mapping) {
      for (const auto& [name, entry] : node->entries) refuse_unknown_variant(entry, name);
      node = node->find(variant);
      if (!node) return {};
    }
    if (node->kind == Node::Kind::text && node->text == "none") return {};
    const auto [size, own] = parsed(*node, "tolerance", parse_case_value);
    if (!(size >= 0)) f.fail(*node, "tolerance", "must not be negative");
    if (own.text == "%") return {Tolerance::Kind::relative, size / 100};
    if (!own.text.empty() && own.quantity != unit.quantity)
      f.fail(*node, "tolerance", fmt::format("is '{}'; give % or the unit of the value, or none", node->text));
    return {Tolerance::Kind::absolute, own.text.empty() ? size : size * own.si / unit.si};
  }

  // `value` where it stands in a table's row; else the item's own.
  Expectation expectation(const Node& node, const std::string& variant, const Node* value, const std::string& evidence,
                          const std::string& source) const {
    const CaseFields f(node, "an expectation", {"quantity", "value", "unit", "tolerance", "evidence", "source", "variants"});
    Expectation out;
    out.quantity = f.need("quantity").text;
    const Node& given = value ? *value : f.need("value");
    std::tie(out.value, out.unit) = parsed(given, value ? out.quantity : "value", parse_case_value);
    if (const Node* unit = f.find("unit")) {
      if (!out.unit.text.empty()) f.fail(given, "value", "has a unit of its own beside the key unit; keep one of them");
      out.unit = parsed(*unit, "unit", parse_case_unit);
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

  // One case for each variant that is wanted; `number`: of a table's row, from 1.
  template <class Expect>
  void spread(const CaseSetup& s, int number, const Overrides& row, const std::string& row_name, const std::string& place,
              Expect&& expect) {
    for (const auto& [variant, set] : variants()) {
      if (!wanted(s, variant)) continue;
      CheckCase c;
      c.name = row_name.empty() ? s.name : s.name + ", " + row_name;
      c.variant = variant;
      c.scene = s.scene;
      c.place = place;
      c.search = s.search;
      c.skipped = skipped(s, number);
      for (const Overrides& part : {set, s.set, row, last_overrides(s)}) c.set.insert(c.set.end(), part.begin(), part.end());
      expect(c);
      for (const Expectation& e : c.expect) {
        if (e.quantity == "critical" && !c.search) throw SceneError(e.place + ": quantity critical needs a search in its case");
        if (e.quantity != "critical" && c.search) throw SceneError(e.place + ": a case with a search has one quantity: critical");
      }
      if (!c.expect.empty()) expected_.cases.push_back(std::move(c));
    }
  }

  void add_case(const Node& node) {
    const CaseFields f(node, "a case", {"name", "scene", "set", "quick", "search", "variants", "evidence", "source", "expect"});
    f.need("name"), f.need("expect");
    const std::string evidence = f.text("evidence"), source = f.text("source");
    spread(setup(f), 0, {}, "", node.place, [&](CheckCase& c) {
      for (const Node& item : f.list("expect")) {
        const Node* own = item.find("variants");
        const CaseFields only(item, "an expectation",
                              {"quantity", "value", "unit", "tolerance", "evidence", "source", "variants"});
        if (own && !holds(variant_list(only, "variants"), c.variant)) continue;
        c.expect.push_back(expectation(item, c.variant, nullptr, evidence, source));
      }
    });
  }

  std::vector<Column> columns(const CaseFields& table) const {
    std::vector<Column> out;
    for (const Node& item : table.list("columns")) {
      Column column;
      if (item.find("set")) {
        const CaseFields f(item, "a column", {"set", "value"});
        column.key = f.text("set");
        column.form = f.text("value", "{}");
      } else {
        const CaseFields f(item, "a column", {"quantity", "unit", "tolerance", "evidence", "source", "variants"});
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
    const CaseFields f(cell, "a cell", {"value", "tolerance", "evidence", "source"});
    Node merged = column;
    for (const auto& [name, entry] : cell.entries)
      if (name != "value") merged.entry(name) = entry;
    return expectation(merged, variant, &f.need("value"), evidence, source);
  }

  void add_table(const Node& node) {
    const CaseFields f(node, "a table",
                       {"name", "scene", "set", "quick", "search", "variants", "evidence", "source", "columns", "rows"});
    f.need("name"), f.need("columns"), f.need("rows");
    const std::vector<Column> heads = columns(f);
    const CaseSetup shared = setup(f, f.list("rows").size());
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
      spread(shared, number, set, fmt::format("{}", fmt::join(words, " / ")), row.place, [&](CheckCase& c) {
        for (std::size_t k = 0; k < heads.size(); ++k) {
          const Node& cell = row.items[k];
          if (!heads[k].quantity || !holds(heads[k].variants, c.variant) || cell.kind == Node::Kind::nothing) continue;
          c.expect.push_back(table_cell(*heads[k].quantity, cell, c.variant, f.text("evidence"), source));
        }
      });
    }
  }

  Expected expected_;
};

}  // namespace

Expected read_expected(const std::string& file, const CaseChoice& choice) {
  return Reader(file, choice).read();
}

}  // namespace couloir
