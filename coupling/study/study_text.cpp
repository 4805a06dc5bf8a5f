#include "coupling/study/study_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/records/console.hpp"

namespace couloir {
namespace {

std::string title(const StudyRow& row) {
  std::string marks = row.variant;
  marks += (marks.empty() ? "" : ", ") + row.mode;
  if (row.seed != 0) marks += fmt::format(", seed {}", row.seed);
  return fmt::format("{} [{}]", row.name, marks);
}

std::string quantity_text(const StudyRow& row, const StudyResult& result, std::size_t k) {
  const StudyQuantity& q = row.quantities[k];
  std::string out = fmt::format("{} = {}", q.path, with_unit(result.values[k], q.unit));
  for (const auto& [path, reference] : row.references)
    if (path == q.path) out += fmt::format(" ({}: {})", reference.source, with_unit(reference.value, q.unit));
  return out;
}

std::string planned_text(const StudyRow& row) {
  return row.search ? fmt::format("up to {} runs, {}", row.search->most_runs(), in_words(row.planned)) : in_words(row.planned);
}

}  // namespace

std::string columns_text(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> width(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  std::string out;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) line += fmt::format("{:<{}}  ", row[k], width[k]);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string percent(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:.2g} %", 100 * share);
}

std::string row_line(const StudyRow& row, const StudyResult& result) {
  std::string out = fmt::format("{:<7} {}: ", to_string(result.status), title(row));
  if (result.status == StudyResult::Status::failed) return out + result.reason;
  for (std::size_t k = 0; k < row.quantities.size(); ++k) out += (k > 0 ? ", " : "") + quantity_text(row, result, k);
  if (result.runs > 1) out += fmt::format("; {} runs", result.runs);
  if (!result.reason.empty()) out += " (" + result.reason + ")";
  return out + (result.seconds > 0 ? "" : "; was there");
}

std::string progress_line(const StudyProgress& p) {
  return fmt::format("{} of {} rows{}", p.done, p.of, p.done < p.of ? fmt::format(", about {} left", in_words(p.left)) : "");
}

std::string results_table(const Study& study, const std::vector<StudyResult>& results) {
  std::vector<std::vector<std::string>> rows{{"status", "row"}};
  for (const StudyQuantity& q : study.quantities) rows[0].push_back(q.path);
  rows[0].emplace_back("processor time");
  std::array<int, 3> count{};
  bool references = false;
  int group = -1;
  for (std::size_t k = 0; k < study.rows.size(); ++k) {
    const StudyRow& row = study.rows[k];
    const StudyResult& r = results[k];
    ++count[static_cast<std::size_t>(r.status)];
    references = references || !row.references.empty();
    const auto line = [&](const std::string& status, const std::string& name, const auto& cell, const std::string& cost) {
      std::vector<std::string> cells{status, name};
      for (const StudyQuantity& q : study.quantities) {
        const auto at = std::ranges::find(row.quantities, q.path, &StudyQuantity::path);
        cells.push_back(at == row.quantities.end() ? "" : cell(q, static_cast<std::size_t>(at - row.quantities.begin())));
      }
      cells.push_back(cost);
      rows.push_back(std::move(cells));
    };
    line(
        to_string(r.status), title(row),
        [&](const StudyQuantity& q, std::size_t at) {
          std::string text = with_unit(r.values[at], q.unit);
          for (const auto& [path, reference] : row.references)
            if (path == q.path) text += fmt::format(" ({:.5g})", reference.value);
          return text;
        },
        r.status == StudyResult::Status::done ? fmt::format("{:.3g} s", r.cpu) : "");
    const bool last_of_group = k + 1 == study.rows.size() || study.rows[k + 1].group != row.group;
    if (r.replicates > 1) group = static_cast<int>(k);
    if (!last_of_group || group < 0) continue;
    const StudyResult& g = results[static_cast<std::size_t>(group)];
    line(
        "", fmt::format("  mean and scatter of {}", g.replicates),
        [&](const StudyQuantity& q, std::size_t at) {
          return fmt::format("{} +- {:.2g}", with_unit(g.mean[at], q.unit), g.scatter[at]);
        },
        "");
    group = -1;
  }
  return columns_text(rows) + fmt::format("{} done, {} failed, {} not run{}\n", count[1], count[2], count[0],
                                          references ? "; in brackets: the reference" : "");
}

std::string dry_run_table(const Study& study, const std::vector<DryRow>& dry, int jobs) {
  std::vector<std::vector<std::string>> rows{{"", "row", "planned", "sets"}};
  double left = 0;
  for (std::size_t k = 0; k < study.rows.size(); ++k) {
    const StudyRow& row = study.rows[k];
    std::string set;
    for (const auto& [key, value] : row.set) set += (set.empty() ? "" : " ") + key + "=" + value;
    rows.push_back({dry[k].done ? "is there" : "to run", title(row), planned_text(row), set});
    if (!dry[k].done) left += row.planned;
  }
  return columns_text(rows) + fmt::format("{} rows; about {} of one core by the plan, {} with {} at a time\n", study.rows.size(),
                                          in_words(left), in_words(left / jobs), jobs);
}

nlohmann::ordered_json dry_run_json(const Study& study, const std::vector<DryRow>& dry) {
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < study.rows.size(); ++k) {
    const StudyRow& row = study.rows[k];
    nlohmann::ordered_json set;
    for (const auto& [key, value] : row.set) set[key] = value;
    rows.push_back({{"name", row.name},
                    {"table", row.table},
                    {"variant", row.variant},
                    {"mode", row.mode},
                    {"seed", row.seed == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(row.seed)},
                    {"set", set},
                    {"search", row.search.has_value()},
                    {"runs_at_most", row.search ? row.search->most_runs() : 1},
                    {"planned", row.planned},
                    {"done", dry[k].done}});
  }
  return {{"study", study.name}, {"rows", rows}};
}

}  // namespace couloir
