#include "coupling/study/study_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "coupling/study/ladder.hpp"

namespace couloir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A slash would be a folder in HDF5.
std::string column_name(std::string path) {
  if (const auto bar = path.find(" / "); bar != std::string::npos) path.replace(bar, 3, " over ");
  return path;
}

class Table {
 public:
  Table(const Study& study, const std::vector<StudyResult>& results) : study_(study), results_(results) {}

  void texts(const std::string& name, const std::string& role, const std::string& what,
             const std::function<std::string(std::size_t)>& value) {
    StudyTableColumn& c = columns.emplace_back();
    c.name = c.label = name, c.description = what, c.role = role, c.text = true;
    for (std::size_t k = 0; k < study_.rows.size(); ++k) c.texts.push_back(value(k));
  }

  StudyTableColumn& numbers(const std::string& name, const std::string& unit, const std::string& role, const std::string& what,
                            const std::function<double(std::size_t)>& value) {
    StudyTableColumn& c = columns.emplace_back();
    c.name = c.label = name, c.unit = unit.empty() ? "1" : unit, c.description = what, c.role = role;
    for (std::size_t k = 0; k < study_.rows.size(); ++k) c.numbers.push_back(value(k));
    return c;
  }

  // A number where all rows have numbers of one kind, in the unit of the first; else what the file says.
  void parameter(const StudyParameter& p) {
    std::vector<double> values(study_.rows.size(), nan);
    CaseUnit unit;
    bool first = true, same = true;
    for (std::size_t k = 0; k < study_.rows.size() && same; ++k) {
      const auto cell = std::ranges::find(study_.rows[k].parameters, p.key, &std::pair<std::string, std::string>::first);
      if (cell == study_.rows[k].parameters.end()) continue;
      try {
        auto [value, own] = parse_case_value(cell->second);
        if (own.text.empty())
          own = std::ranges::find(study_.rows[k].units, p.key, &std::pair<std::string, CaseUnit>::first)->second;
        if (first) unit = own, first = false;
        same = own.quantity == unit.quantity;
        values[k] = own.text == unit.text ? value : value * own.si / unit.si;
      } catch (const std::invalid_argument&) {
        same = false;
      }
    }
    if (same) {
      numbers(p.key, unit.text, "parameter", "key of the scene", [&](std::size_t k) { return values[k]; }).label = p.label;
      return;
    }
    texts(p.key, "parameter", "key of the scene, as written", [&](std::size_t k) {
      const auto cell = std::ranges::find(study_.rows[k].parameters, p.key, &std::pair<std::string, std::string>::first);
      return cell == study_.rows[k].parameters.end() ? "" : cell->second;
    });
    columns.back().label = p.label;
  }

  void quantity(const StudyQuantity& q) {
    const std::string name = column_name(q.path);
    const auto of = [&](const std::vector<double> StudyResult::*values) {
      return [&, values](std::size_t k) {
        const auto& own = study_.rows[k].quantities;
        const auto at = std::ranges::find(own, q.path, &StudyQuantity::path);
        return at == own.end() ? nan : (results_[k].*values)[static_cast<std::size_t>(at - own.begin())];
      };
    };
    const auto add = [&](const std::string& suffix, const std::string& role, const std::string& what,
                         const std::function<double(std::size_t)>& value) {
      numbers(name + suffix, q.unit.text, role, what, value).label = q.label;
    };
    const std::string what = q.path == "critical" ? "smallest value that the search found good" : "of summary.json: " + q.path;
    add("", "quantity", what, of(&StudyResult::values));
    add(" mean", "mean", "over the replicates", of(&StudyResult::mean));
    add(" scatter", "scatter", "over the replicates: standard deviation of a sample, n - 1", of(&StudyResult::scatter));
    std::string source;
    for (const StudyRow& row : study_.rows)
      for (const auto& [path, reference] : row.references)
        if (path == q.path && source.find(reference.source) == std::string::npos)
          source += (source.empty() ? "" : ", ") + reference.source;
    if (source.empty()) return;
    add(" reference", "reference", source, [&](std::size_t k) {
      for (const auto& [path, reference] : study_.rows[k].references)
        if (path == q.path) return reference.value;
      return nan;
    });
  }

  // Of the ladder's rungs, as shares of the reference.
  void errors(const std::vector<LadderFigures>& all) {
    const auto add = [&](std::size_t q, const std::string& name, const std::string& what, double RungFigures::*value) {
      numbers(column_name(study_.ladder->quantities[q].path) + " " + name, "", name, what, [&, q, value](std::size_t k) {
        return study_.rows[k].rung < 0 ? nan : all[q].rungs[std::size_t(study_.rows[k].rung)].*value;
      }).label = study_.ladder->quantities[q].label;
    };
    for (std::size_t q = 0; q < all.size(); ++q) {
      add(q, "error", "of one run of this rung: bias and scatter", &RungFigures::error);
      add(q, "bias", "of the rung's mean, over the reference", &RungFigures::bias);
      add(q, "doubt", "to which the bias is known", &RungFigures::doubt);
    }
  }

  std::vector<StudyTableColumn> columns;

 private:
  const Study& study_;
  const std::vector<StudyResult>& results_;
};

// As a spreadsheet reads it (RFC 4180).
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace

std::vector<StudyTableColumn> study_table(const Study& study, const std::vector<StudyResult>& results) {
  Table t(study, results);
  const auto& rows = study.rows;
  const auto whole = [](double n) { return n; };
  t.texts("table", "label", "of study.yaml", [&](std::size_t k) { return rows[k].table; });
  t.texts("variant", "label", "of study.yaml; empty: it has none", [&](std::size_t k) { return rows[k].variant; });
  if (study.ladder)
    t.texts("rung", "label", "of the ladder",
            [&](std::size_t k) { return rows[k].rung < 0 ? "" : study.ladder->rungs[std::size_t(rows[k].rung)].name; });
  t.texts("mode", "label", "which models ran", [&](std::size_t k) { return rows[k].mode; });
  t.numbers("seed", "", "label", "of the grains; without grains there is none",
            [&](std::size_t k) { return rows[k].seed == 0 ? nan : static_cast<double>(rows[k].seed); });
  for (const StudyParameter& p : study.parameters) t.parameter(p);
  for (const StudyQuantity& q : study.quantities) t.quantity(q);
  if (study.ladder) t.errors(ladder_figures(study, results));
  t.numbers("replicates", "", "record", "rows of this setting that are done, of which mean and scatter are",
            [&](std::size_t k) { return whole(results[k].replicates); });
  t.numbers("runs", "", "record", "behind this row; more than one: a search",
            [&](std::size_t k) { return whole(results[k].runs); });
  t.numbers("cpu", "s", "cost", "processor time of its runs, when they were made", [&](std::size_t k) { return results[k].cpu; });
  t.numbers("wall", "s", "cost", "time its runs took, when they were made", [&](std::size_t k) { return results[k].wall; });
  t.numbers("cell updates", "", "cost", "cells times steps of its runs", [&](std::size_t k) { return results[k].cell_updates; });
  t.numbers("particle steps", "", "cost", "grains times steps of its runs",
            [&](std::size_t k) { return results[k].particle_steps; });
  t.texts("status", "record", "done, failed, or not run", [&](std::size_t k) { return to_string(results[k].status); });
  t.texts("reason", "record", "why it failed, or what else to know", [&](std::size_t k) { return results[k].reason; });
  t.texts("run", "record", "folder of the run; of a search: at its critical value",
          [&](std::size_t k) { return results[k].run; });
  t.texts("hash", "record", "of the complete scene and the program's revision", [&](std::size_t k) { return results[k].hash; });
  t.texts("command", "record", "that runs it again", [&](std::size_t k) { return results[k].command; });
  for (StudyTableColumn& c : t.columns) {  // obstacles.wall.overflow is a key, and a quantity
    if (c.role == "parameter" && std::ranges::count(t.columns, c.name, &StudyTableColumn::name) > 1) c.name += " set";
  }
  return std::move(t.columns);
}

std::string study_csv(const std::vector<StudyTableColumn>& columns) {
  std::vector<std::string> cells;
  for (const StudyTableColumn& c : columns)
    cells.push_back(csv_cell(c.text || c.unit == "1" ? c.name : fmt::format("{} [{}]", c.name, c.unit)));
  std::vector<std::string> lines{fmt::format("{}", fmt::join(cells, ","))};
  for (std::size_t k = 0; k < columns.front().texts.size(); ++k) {
    cells.clear();
    for (const StudyTableColumn& c : columns) {
      if (c.text)
        cells.push_back(csv_cell(c.texts[k]));
      else
        cells.push_back(std::isnan(c.numbers[k]) ? "" : fmt::format("{}", c.numbers[k]));
    }
    lines.push_back(fmt::format("{}", fmt::join(cells, ",")));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

nlohmann::ordered_json study_json(const std::vector<StudyTableColumn>& columns) {
  auto out = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < columns.front().texts.size(); ++k) {
    nlohmann::ordered_json row;
    for (const StudyTableColumn& c : columns) {
      if (c.text)
        row[c.name] = c.texts[k];
      else
        row[c.name] = std::isfinite(c.numbers[k]) ? nlohmann::ordered_json(c.numbers[k]) : nlohmann::ordered_json();
    }
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace couloir
