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
  using Row = std::array<std::string, 9>;
  std::vector<Row> rows{{"verdict", "experiment", "case", "quantity", "value", "expected", "deviation", "allowed", "evidence"}};
  std::array<long, 4> count{};
  for (const Finding& f : findings) {
    const Expectation& e = f.expectation;
    ++count[static_cast<std::size_t>(f.verdict)];
    rows.push_back({to_string(f.verdict), f.experiment, title(f), e.quantity, with_unit(f.value, e.unit),
                    with_unit(e.value, e.unit), percent(f.deviation), allowed(e), fmt::format("{}: {}", e.evidence, e.source)});
  }
  std::array<std::size_t, 9> width{};
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  std::string out;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const bool number = k >= 4 && k <= 7;
      line += fmt::format(fmt::runtime(number ? "{:>{}}  " : "{:<{}}  "), row[k], width[k]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out + fmt::format("{} passed, {} failed, {} shown only, {} skipped\n", count[0], count[1], count[2], count[3]);
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
