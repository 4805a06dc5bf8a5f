#include "coupling/cases/case_unit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "coupling/scene/names.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

struct Own {
  const char *name, *quantity;
  double times, over;
};

// What a summary holds and a scene does not.
constexpr std::array own_units{
    Own{"N", "a force", 1, 1},          Own{"kN", "a force", 1e3, 1},     Own{"N s", "an impulse", 1, 1},
    Own{"%", "a plain number", 1, 100}, Own{"1", "a plain number", 1, 1},
};

constexpr std::array dimensions{Dimension::time_per_velocity, Dimension::length, Dimension::time,
                                Dimension::velocity,          Dimension::mass,   Dimension::density,
                                Dimension::pressure,          Dimension::angle,  Dimension::acceleration};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

// The number that a text starts with, and what follows it.
bool split(std::string_view text, double& number, std::string_view& rest) {
  std::string_view digits = trimmed(text);
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  rest = trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())));
  return error == std::errc() && std::isfinite(number);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Own& unit : own_units) names.emplace_back(unit.name);
  for (const Dimension d : dimensions)
    for (const std::string& name : units_of(d)) names.push_back(name);
  return names;
}

// `whole` is the text that the name stands in.
CaseUnit named_unit(std::string_view name, std::string_view whole) {
  for (const Own& unit : own_units)
    if (name == unit.name) return {std::string(name), unit.quantity, unit.times / unit.over};
  for (const Dimension d : dimensions)
    for (const std::string& known : units_of(d))
      if (name == known) return {known, describe(d), parse_quantity("1 " + known, d)};
  const std::string what = name == whole ? "which" : fmt::format("but '{}'", name);
  throw std::invalid_argument(fmt::format("is '{}', {} is no unit{}", whole, what, suggestion(name, all_names(), "there are")));
}

CaseUnit unit_in(std::string_view text, std::string_view whole) {
  if (text.empty()) return {};
  for (const Own& unit : own_units)
    if (text == unit.name) return named_unit(text, whole);
  double number = 1;
  std::string_view name;
  if (!split(text, number, name)) return named_unit(text, whole);
  if (name.empty() || !(number > 0))
    throw std::invalid_argument(fmt::format("is '{}', but a unit is a name such as N, or a length such as 33.33 mm", whole));
  CaseUnit unit = named_unit(name, whole);
  unit.text = text;
  unit.si *= number;
  return unit;
}

}  // namespace

CaseUnit parse_case_unit(std::string_view text) {
  return unit_in(trimmed(text), trimmed(text));
}

std::pair<double, CaseUnit> parse_case_value(std::string_view text) {
  double number = 0;
  std::string_view name;
  if (!split(text, number, name))
    throw std::invalid_argument(fmt::format("is '{}', but must be a number with a unit, such as 4170 N", trimmed(text)));
  return {number, unit_in(name, trimmed(text))};
}

std::vector<std::string> units_of_quantity(std::string_view quantity) {
  std::vector<std::string> names;
  for (const Own& unit : own_units)
    if (quantity == unit.quantity) names.emplace_back(unit.name);
  for (const Dimension d : dimensions)
    if (quantity == describe(d))
      for (const std::string& name : units_of(d)) names.push_back(name);
  return names;
}

std::string quantity_of_path(std::string_view path) {
  const auto dot = path.rfind('.');
  const std::string_view name = path.substr(dot == std::string_view::npos ? 0 : dot + 1);
  const auto has = [&](std::string_view part) { return name.find(part) != std::string_view::npos; };
  const auto ends = [&](std::string_view part) {
    return name.size() >= part.size() && name.substr(name.size() - part.size()) == part;
  };
  if (name.starts_with("relative_") || name.starts_with("share_") || ends("_per_second")) return "a plain number";
  if (ends("_time") || name == "arrival" || name == "first_contact" || path.starts_with("time."))
    return describe(Dimension::time);
  if (path.starts_with("obstacles.") && std::ranges::count(path, '.') == 4 && path.find(".gauges.") != path.npos) {
    const bool stress = ends("_peak") || ends("_mean") || ends("_final");
    return stress ? describe(Dimension::pressure) : "";
  }
  const bool measure = name == "maximum" || name == "peak" || name == "mean" || name == "final";
  if (name.starts_with("force") || (measure && (path.starts_with("obstacles.") || path.starts_with("walls.")))) return "a force";
  if (name.starts_with("impulse")) return "an impulse";
  if (has("depth") || name == "max_heap" || name == "max_climbed") return describe(Dimension::length);
  if (has("speed") || has("velocity")) return describe(Dimension::velocity);
  if (path.starts_with("mass.") || name == "overflow") return describe(Dimension::mass);
  return "";
}

std::string with_unit(double value, const CaseUnit& unit) {
  if (std::isnan(value)) return "-";
  if (unit.text.empty() || unit.text == "1") return fmt::format("{:.5g}", value);
  const bool named = !std::isdigit(static_cast<unsigned char>(unit.text.front()));
  return fmt::format("{:.5g} {}{}", value, named ? "" : "x ", unit.text);
}

}  // namespace couloir
