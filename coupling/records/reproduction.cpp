#include "coupling/records/reproduction.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "coupling/records/compare_summary.hpp"
#include "coupling/records/summary_file.hpp"

namespace couloir {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

std::string makers_text(const std::vector<Maker>& makers) {
  std::string out;
  std::vector<std::string> same;
  const auto told = [](const std::string& text) { return text.empty() ? "not recorded" : text; };
  for (const Maker& m : makers) {
    if (m.first == m.second)
      same.push_back(m.what);
    else
      out += fmt::format("  {}: {}; now {}\n", m.what, told(m.first), told(m.second));
  }
  if (out.empty()) return "made alike: build, libraries, engine, machine, threads and ranks are the same\n";
  return fmt::format("made otherwise:\n{}  the same: {}\n", out, fmt::join(same, ", "));
}

std::string quantity_line(const Reproduction& r, const QuantityDifference& q) {
  if (q.same_bits) return fmt::format("  {:<40}  the same bits\n", q.name);
  const std::string mark = !r.counts(q) ? "" : r.holds(q) ? "  within" : "  BEYOND";
  if (std::isnan(q.largest)) return fmt::format("  {:<40}  only one of the two has it{}\n", q.name, mark);
  const std::string unit = q.unit == "1" ? "" : " " + q.unit;
  const std::string when = std::isnan(q.time) ? "" : fmt::format(", at {:.4g} s", q.time);
  return fmt::format("  {:<40}  {:.3g}{}, {:.2g} of the largest{}{}\n", q.name, q.largest, unit, q.relative(), when, mark);
}

std::string verdict_text(const Reproduction& r) {
  const std::string held = r.grains ? "impulses, masses and volumes" : "all quantities";
  switch (r.verdict()) {
    case Reproduction::Verdict::same_bits:
      return "reproduced: the same bits";
    case Reproduction::Verdict::within:
      return fmt::format("reproduced: not the same bits, but {} agree within {:.2g}", held, r.tolerance);
    default:
      break;
  }
  if (r.records_verdict() != Reproduction::Verdict::differs) return "NOT reproduced: the record is, but not its summary.json";
  const bool beyond = std::ranges::any_of(r.quantities, [&](const auto& q) { return r.counts(q) && !r.holds(q); });
  return fmt::format("NOT reproduced: {}", !beyond ? "the same build on the same kind of machine must give the same bits"
                                                   : fmt::format("beyond the tolerance of {:.2g}", r.tolerance));
}

}  // namespace

Reproduction::Verdict Reproduction::verdict() const {
  return summary.empty() ? records_verdict() : Verdict::differs;
}

Reproduction::Verdict Reproduction::records_verdict() const {
  if (first_difference.empty()) return Verdict::same_bits;
  const bool all = std::ranges::all_of(quantities, [&](const QuantityDifference& q) { return !counts(q) || holds(q); });
  return all && !bits_expected ? Verdict::within : Verdict::differs;
}

double default_tolerance(bool grains) {
  return grains ? 0.05 : 1e-6;
}

Reproduction reproduction(const RecordsReader& first, const RecordsReader& second, double tolerance) {
  Reproduction out;
  out.makers = makers(first, second);
  out.first_difference = first_difference(first, second);
  out.quantities = differences(first, second);
  out.grains = first.text("mode") != "continuum";
  out.tolerance = tolerance;
  out.bits_expected = same_makers(out.makers);
  return out;
}

void compare_summaries(Reproduction& r, const std::string& first, const std::string& second) {
  const SummaryFile a = read_summary(first), b = read_summary(second);
  for (const auto& [file, path] : {std::pair{&a, &first}, {&b, &second}})
    if (r.summary.empty() && !file->fault.empty())
      r.summary = fmt::format("{} {}, so that its figures cannot be compared", *path, file->fault);
  if (!r.summary.empty() || r.records_verdict() == Reproduction::Verdict::differs) return;
  const std::string found =
      summary_difference(a.content, b.content, r.bits_expected ? std::nullopt : std::optional(r.tolerance), r.grains);
  if (!found.empty()) r.summary = "summary.json is not of this record: " + found;
}

const char* to_string(Reproduction::Verdict verdict) {
  switch (verdict) {
    case Reproduction::Verdict::same_bits:
      return "same bits";
    case Reproduction::Verdict::within:
      return "within tolerance";
    default:
      return "differs";
  }
}

std::string reproduction_text(const Reproduction& r) {
  std::string out = r.name.empty() ? "" : r.name + "\n";
  out += makers_text(r.makers);
  out += fmt::format("expected: {}\n", r.bits_expected ? "the same bits" : fmt::format("agreement within {:.2g}", r.tolerance));
  if (!r.first_difference.empty()) {
    out += fmt::format("largest differences{}:\n",
                       r.grains ? "; unmarked ones are told, not judged, since grains magnify a rounding" : "");
    for (const QuantityDifference& q : r.quantities) out += quantity_line(r, q);
    out += fmt::format("first other bits: {}\n", r.first_difference);
  }
  if (!r.summary.empty()) out += r.summary + "\n";
  return out + verdict_text(r) + "\n";
}

Json reproduction_json(const Reproduction& r) {
  Json makers = Json::array(), quantities = Json::array();
  for (const Maker& m : r.makers) makers.push_back({{"what", m.what}, {"first", m.first}, {"now", m.second}});
  for (const QuantityDifference& q : r.quantities)
    quantities.push_back({{"quantity", q.name},
                          {"unit", q.unit},
                          {"largest", number(q.largest)},
                          {"relative", number(q.relative())},
                          {"time", number(q.time)},
                          {"same_bits", q.same_bits},
                          {"judged", r.counts(q)}});
  return {{"name", r.name},
          {"verdict", to_string(r.verdict())},
          {"expected", r.bits_expected ? "same bits" : "within tolerance"},
          {"tolerance", r.tolerance},
          {"first_difference", r.first_difference},
          {"summary", r.summary},
          {"made_by", makers},
          {"quantities", quantities}};
}

}  // namespace couloir
