#include "coupling/check/check_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace couloir {
namespace {

std::string percent(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:+.2f} %", 100 * share);
}

std::string allowed(const Expectation& e) {
  switch (e.tolerance.kind) {
    case Tolerance::Kind::none:
      return "none";
    case Tolerance::Kind::relative:
      return fmt::format("{:.4g} %", 100 * e.tolerance.size);
    case Tolerance::Kind::absolute:
      return with_unit(e.tolerance.size, e.unit);
  }
  return "?";
}

std::string title(const Finding& f) {
  return f.variant.empty() ? f.name : fmt::format("{} [{}]", f.name, f.variant);
}

using Row = std::array<std::string, 7>;

// A ratio of two long names goes over two rows: the second holds the divisor alone.
std::vector<Row> rows_of(const Finding& f) {
  constexpr std::size_t longest = 44;
  const Expectation& e = f.expectation;
  const std::size_t slash = e.quantity.size() > longest ? e.quantity.find(" / ") : std::string::npos;
  std::vector<Row> rows{{to_string(f.verdict), "  " + e.quantity.substr(0, slash), with_unit(f.value, e.unit),
                         with_unit(e.value, e.unit), percent(f.deviation), allowed(e), e.evidence}};
  if (slash != std::string::npos) rows.push_back({"", "  " + e.quantity.substr(slash)});
  return rows;
}

std::string aligned(const Row& row, const std::array<std::size_t, 7>& width) {
  std::string line;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const bool number = k >= 2 && k <= 5;
    line += fmt::format(fmt::runtime(number ? "{:>{}}  " : "{:<{}}  "), row[k], width[k]);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

// What --quick left out: "skipped by --quick: cuboid_force 48, eta_study 33".
std::string skipped_lines(const std::vector<Finding>& findings) {
  std::vector<std::pair<std::string, long>> count;
  for (const Finding& f : findings) {
    if (f.verdict != Verdict::skipped) continue;
    if (count.empty() || count.back().first != f.experiment) count.emplace_back(f.experiment, 0);
    ++count.back().second;
  }
  if (count.empty()) return "";
  std::string out, line = "skipped by --quick:";
  for (std::size_t k = 0; k < count.size(); ++k) {
    const std::string part = fmt::format("{} {}{}", count[k].first, count[k].second, k + 1 < count.size() ? "," : "");
    if (line.size() + part.size() > 110) out += line + "\n", line = " ";
    line += " " + part;
  }
  out += line;
  return out + "\n";
}

}  // namespace

std::string finding_line(const Finding& f) {
  const Expectation& e = f.expectation;
  const std::string head = fmt::format("{:<7} {}, {}: {}", to_string(f.verdict), f.experiment, title(f), e.quantity);
  if (f.verdict == Verdict::skipped) return head;
  const std::string tail = f.reason.empty() ? "" : "; " + f.reason;
  return fmt::format("{} = {}, expected {} ({}, allowed {}; {}: {}){}", head, with_unit(f.value, e.unit),
                     with_unit(e.value, e.unit), percent(f.deviation), allowed(e), e.evidence, e.source, tail);
}

std::string findings_table(const std::vector<Finding>& findings) {
  const Row head{"verdict", "quantity", "value", "expected", "deviation", "allowed", "evidence"};
  std::array<std::size_t, 7> width{};
  const auto widen = [&](const Row& row) {
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  };
  std::array<long, 4> count{};
  widen(head);
  for (const Finding& f : findings) {
    ++count[static_cast<std::size_t>(f.verdict)];
    if (f.verdict != Verdict::skipped) std::ranges::for_each(rows_of(f), widen);
  }
  std::string out = aligned(head, width), last;
  for (const Finding& f : findings) {
    if (f.verdict == Verdict::skipped) continue;
    const std::string group = fmt::format("{}: {}", f.experiment, title(f));
    if (group != last) out += group + "\n";
    last = group;
    for (const Row& row : rows_of(f)) out += aligned(row, width);
  }
  return out + skipped_lines(findings) +
         fmt::format("{} passed, {} failed, {} shown only, {} skipped\n", count[0], count[1], count[2], count[3]);
}

nlohmann::ordered_json findings_json(const std::vector<Finding>& findings) {
  const auto number = [](double x) { return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(); };
  auto out = nlohmann::ordered_json::array();
  for (const Finding& f : findings) {
    const Expectation& e = f.expectation;
    std::string verdict = to_string(f.verdict);
    std::ranges::transform(verdict, verdict.begin(), [](unsigned char c) { return std::tolower(c); });
    nlohmann::ordered_json item{{"verdict", verdict},     {"experiment", f.experiment}, {"case", f.name},
                                {"variant", f.variant},   {"quantity", e.quantity},     {"value", number(f.value)},
                                {"expected", e.value},    {"unit", e.unit.text},        {"deviation", number(f.deviation)},
                                {"evidence", e.evidence}, {"source", e.source},         {"reason", f.reason},
                                {"run", f.run},           {"command", f.command}};
    item["tolerance"] = e.tolerance.kind == Tolerance::Kind::none ? nlohmann::ordered_json() : number(e.tolerance.size);
    item["tolerance_is"] = e.tolerance.kind == Tolerance::Kind::relative   ? "relative"
                           : e.tolerance.kind == Tolerance::Kind::absolute ? "absolute"
                                                                           : "none";
    out.push_back(item);
  }
  return out;
}

}  // namespace couloir
