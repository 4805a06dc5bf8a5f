#include "coupling/study/study_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/cases/search.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

void put(StudyCells& cells, const StudyColumn& column, const Node& cell) {
  if (!column.reference.empty()) {
    if (cell.kind != Node::Kind::nothing) cells.references.emplace_back(&column, &cell);
    return;
  }
  const std::string text = override_text(cell);
  cells.parameters.emplace_back(column.key, text);
  cells.set.emplace_back(column.key, filled(column.form, text));
  cells.name += (cells.name.empty() ? "" : " / ") + text;
}

std::vector<StudyCells> rows_as_given(const std::vector<Node>& rows, const std::vector<StudyColumn>& columns) {
  std::vector<StudyCells> out;
  for (const Node& row : rows) {
    if (row.kind != Node::Kind::list || row.items.size() != columns.size())
      throw SceneError(fmt::format("{}: a row is a list with a value for each of the {} columns", row.place, columns.size()));
    StudyCells& cells = out.emplace_back();
    cells.place = row.place;
    for (std::size_t k = 0; k < columns.size(); ++k) put(cells, columns[k], row.items[k]);
  }
  return out;
}

// The last column changes fastest.
std::vector<StudyCells> product(const std::vector<StudyColumn>& columns, const std::string& place) {
  std::vector<StudyCells> out(1);
  out[0].place = place;
  for (const StudyColumn& column : columns) {
    std::vector<StudyCells> longer;
    for (const StudyCells& cells : out) {
      for (const Node& value : column.node->find("values")->items) put(longer.emplace_back(cells), column, value);
    }
    out = std::move(longer);
  }
  return out;
}

}  // namespace

std::vector<StudyColumn> study_columns(const CaseFields& table) {
  std::vector<StudyColumn> out;
  const bool given = table.find("rows") != nullptr;
  for (const Node& item : table.list("columns")) {
    StudyColumn& column = out.emplace_back();
    column.node = &item;
    if (item.find("reference")) {
      const CaseFields f(item, "a column", {"reference", "unit", "source"});
      column.reference = f.need("reference").text;
      column.unit = f.text("unit");
      column.source = f.text("source");
      if (column.source.empty()) f.fail(item, "source", "is missing: say where the reference comes from");
      if (!given) f.fail(item, "reference", "needs rows: beside every combination of values there is no place for it");
      continue;
    }
    const CaseFields f(item, "a column", {"set", "value", "values", "name", "reference"});
    column.key = f.need("set").text;
    column.form = f.text("value", "{}");
    column.label = f.text("name", column.key);
    if (column.form.find("{}") == std::string::npos) f.fail(f.need("value"), "value", "needs {} where the cell stands");
    if (given && f.find("values")) f.fail(f.need("values"), "values", "stand in the rows of this table; keep one of the two");
    if (!given && f.list("values").empty()) f.fail(item, "values", "are missing: a list for this column, or rows for the table");
    if (std::ranges::count(out, column.key, &StudyColumn::key) > 1) f.fail(item, "set", column.key + " is a column already");
  }
  return out;
}

std::vector<StudyCells> study_cells(const CaseFields& table, const std::vector<StudyColumn>& columns, const std::string& place) {
  if (!table.find("rows")) return product(columns, place);
  if (table.list("rows").empty()) table.fail(table.need("rows"), "rows", "are empty");
  return rows_as_given(table.list("rows"), columns);
}

}  // namespace couloir
