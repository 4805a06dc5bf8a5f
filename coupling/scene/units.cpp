#include "coupling/scene/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

namespace couloir {
namespace {

// A unit is times / over of the SI unit: 933.5 mm is 933.5 / 1000, correctly rounded, where 933.5 * 0.001 is not.
struct Unit {
  const char* name;
  Dimension dimension;
  double times, over;
};

constexpr std::array units{
    Unit{"m", Dimension::length, 1, 1},
    Unit{"mm", Dimension::length, 1, 1e3},
    Unit{"cm", Dimension::length, 1, 1e2},
    Unit{"km", Dimension::length, 1e3, 1},
    Unit{"s", Dimension::time, 1, 1},
    Unit{"ms", Dimension::time, 1, 1e3},
    Unit{"us", Dimension::time, 1, 1e6},
    Unit{"min", Dimension::time, 60, 1},
    Unit{"m/s", Dimension::velocity, 1, 1},
    Unit{"mm/s", Dimension::velocity, 1, 1e3},
    Unit{"cm/s", Dimension::velocity, 1, 1e2},
    Unit{"km/h", Dimension::velocity, 1, 3.6},
    Unit{"m/s2", Dimension::acceleration, 1, 1},
    Unit{"m/s^2", Dimension::acceleration, 1, 1},
    Unit{"s2/m", Dimension::time_per_velocity, 1, 1},
    Unit{"s^2/m", Dimension::time_per_velocity, 1, 1},
    Unit{"kg", Dimension::mass, 1, 1},
    Unit{"g", Dimension::mass, 1, 1e3},
    Unit{"t", Dimension::mass, 1e3, 1},
    Unit{"kg/m3", Dimension::density, 1, 1},
    Unit{"kg/m^3", Dimension::density, 1, 1},
    Unit{"g/cm3", Dimension::density, 1e3, 1},
    Unit{"Pa", Dimension::pressure, 1, 1},
    Unit{"kPa", Dimension::pressure, 1e3, 1},
    Unit{"MPa", Dimension::pressure, 1e6, 1},
    Unit{"GPa", Dimension::pressure, 1e9, 1},
    Unit{"rad", Dimension::angle, 1, 1},
    Unit{"deg", Dimension::angle, std::numbers::pi, 180},
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

std::string allowed(Dimension dimension) {
  return dimension == Dimension::none ? "write a number without a unit"
                                      : fmt::format("write one of {}", fmt::join(units_of(dimension), ", "));
}

}  // namespace

const char* describe(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "a plain number";
    case Dimension::length:
      return "a length";
    case Dimension::time:
      return "a time";
    case Dimension::velocity:
      return "a velocity";
    case Dimension::acceleration:
      return "an acceleration";
    case Dimension::time_per_velocity:
      return "a time per velocity";
    case Dimension::mass:
      return "a mass";
    case Dimension::density:
      return "a density";
    case Dimension::pressure:
      return "a pressure";
    case Dimension::angle:
      return "an angle";
  }
  return "?";
}

std::vector<std::string> units_of(Dimension dimension) {
  std::vector<std::string> names;
  for (const Unit& unit : units) {
    if (unit.dimension == dimension && dimension != Dimension::none) names.emplace_back(unit.name);
  }
  return names;
}

std::string si_unit(Dimension dimension) {
  const auto names = units_of(dimension);
  return names.empty() ? "" : names.front();
}

double Scales::of(Dimension dimension) const {
  if (length == 0) return 1;
  switch (dimension) {
    case Dimension::length:
      return length;
    case Dimension::time:
      return std::sqrt(length / gravity);
    case Dimension::velocity:
      return std::sqrt(length * gravity);
    case Dimension::time_per_velocity:
      return 1 / gravity;
    case Dimension::mass:
      return density * length * length * length;
    case Dimension::pressure:
      return density * gravity * length;
    default:
      return 1;
  }
}

double parse_quantity(std::string_view text, Dimension dimension, const Scales& scales) {
  const std::string_view whole = trimmed(text);
  std::string_view digits = whole;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc::result_out_of_range) {
    throw QuantityError(fmt::format("is '{}', which no double precision number can hold", whole));
  }
  if (error != std::errc() || !std::isfinite(number)) {
    throw QuantityError(fmt::format("is '{}', but must be {}: {}", whole, describe(dimension),
                                    dimension == Dimension::none ? "write a number without a unit"
                                                                 : fmt::format("a number and {}", allowed(dimension).substr(6))));
  }
  const std::string_view name = trimmed(digits.substr(end - digits.data()));
  if (name.empty()) {
    if (dimension == Dimension::angle && number != 0) {
      throw QuantityError(fmt::format("is {0}, an angle without a unit; write '{0} deg' or '{0} rad'", whole));
    }
    return number * scales.of(dimension);
  }
  for (const Unit& unit : units) {
    if (name == unit.name && unit.dimension == dimension) return number * unit.times / unit.over;
  }
  throw QuantityError(
      fmt::format("is '{}', but '{}' is not a unit of {}; {}", whole, name, describe(dimension), allowed(dimension)));
}

std::string exact_quantity(double value, Dimension dimension) {
  const std::string unit = si_unit(dimension);
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

std::string short_quantity(double value, Dimension dimension) {
  const double size = std::abs(value);
  const bool small = size > 0 && size < 1;
  switch (dimension) {
    case Dimension::none:
      return fmt::format("{:.6g}", value);
    case Dimension::length:
      if (small) return fmt::format("{:.6g} mm", value * 1e3);
      break;
    case Dimension::time:
      if (small) return fmt::format("{:.6g} ms", value * 1e3);
      break;
    case Dimension::pressure:
      if (size >= 1e6) return fmt::format("{:.6g} MPa", value * 1e-6);
      break;
    case Dimension::angle:
      return fmt::format("{:.6g} deg", value * 180 / std::numbers::pi);
    default:
      break;
  }
  return fmt::format("{:.6g} {}", value, si_unit(dimension));
}

}  // namespace couloir
