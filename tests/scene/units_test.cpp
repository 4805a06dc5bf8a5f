#include "coupling/scene/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace couloir {
namespace {

std::string complaint(const char* text, Dimension dimension) {
  try {
    parse_quantity(text, dimension);
  } catch (const QuantityError& e) {
    return e.what();
  }
  return "";
}

TEST(Units, ReadsEachDimensionToTheNearestDouble) {
  using enum Dimension;
  EXPECT_EQ(parse_quantity("80 mm", length), 0.08);
  EXPECT_EQ(parse_quantity("933.5 mm", length), 0.9335);
  EXPECT_EQ(parse_quantity(" 12cm ", length), 0.12);
  EXPECT_EQ(parse_quantity("1.5 km", length), 1500);
  EXPECT_EQ(parse_quantity("1639 kg/m3", density), 1639);
  EXPECT_EQ(parse_quantity("1.41 kg", mass), 1.41);
  EXPECT_EQ(parse_quantity("250 g", mass), 0.25);
  EXPECT_EQ(parse_quantity("1.5 s", time), 1.5);
  EXPECT_EQ(parse_quantity("20 ms", time), 0.02);
  EXPECT_EQ(parse_quantity("5 MPa", pressure), 5e6);
  EXPECT_EQ(parse_quantity("9.81 m/s2", acceleration), 9.81);
  EXPECT_EQ(parse_quantity("2 m/s", velocity), 2);
  EXPECT_EQ(parse_quantity("36 km/h", velocity), 10);
  EXPECT_DOUBLE_EQ(parse_quantity("40 deg", angle), 40 * std::numbers::pi / 180);
  EXPECT_EQ(parse_quantity("0.7 rad", angle), 0.7);
  EXPECT_EQ(parse_quantity("-3e-2", none), -0.03);
  EXPECT_EQ(parse_quantity("+4", none), 4);
}

TEST(Units, ReadsBareNumbersAsSi) {
  EXPECT_EQ(parse_quantity("0.25", Dimension::length), 0.25);
  EXPECT_EQ(parse_quantity("0", Dimension::angle), 0);
}

TEST(Units, RefusesABareAngle) {
  EXPECT_EQ(complaint("40", Dimension::angle), "is 40, an angle without a unit; write '40 deg' or '40 rad'");
}

TEST(Units, NamesTheAllowedUnits) {
  EXPECT_EQ(complaint("80 kg", Dimension::length), "is '80 kg', but 'kg' is not a unit of a length; write one of m, mm, cm, km");
  EXPECT_EQ(complaint("1 m", Dimension::none),
            "is '1 m', but 'm' is not a unit of a plain number; write a number without a unit");
  EXPECT_EQ(complaint("wide", Dimension::length), "is 'wide', but must be a length: a number and one of m, mm, cm, km");
  EXPECT_EQ(complaint("nan", Dimension::none), "is 'nan', but must be a plain number: write a number without a unit");
  EXPECT_EQ(complaint("1e999", Dimension::none), "is '1e999', which no double precision number can hold");
}

TEST(Units, ScalesBareNumbersOnly) {
  const Scales scales{0.03333, 9.81, 639};
  EXPECT_EQ(parse_quantity("2.4", Dimension::length, scales), 2.4 * 0.03333);
  EXPECT_EQ(parse_quantity("80 mm", Dimension::length, scales), 0.08);
  EXPECT_DOUBLE_EQ(parse_quantity("24", Dimension::time, scales), 24 * std::sqrt(0.03333 / 9.81));
  EXPECT_NEAR(parse_quantity("1", Dimension::time, scales), 0.05829, 5e-6);  // the seed's
  EXPECT_DOUBLE_EQ(parse_quantity("2", Dimension::velocity, scales), 2 * std::sqrt(0.03333 * 9.81));
  EXPECT_DOUBLE_EQ(parse_quantity("3", Dimension::mass, scales), 3 * 639 * std::pow(0.03333, 3));
  EXPECT_DOUBLE_EQ(parse_quantity("1", Dimension::pressure, scales), 639 * 9.81 * 0.03333);
  EXPECT_EQ(parse_quantity("0.45", Dimension::none, scales), 0.45);
  EXPECT_THROW(parse_quantity("40", Dimension::angle, scales), QuantityError);
}

TEST(Units, WritesExactly) {
  for (const double value : {0.1, 1.0 / 3, 0.9335, 40 * std::numbers::pi / 180, 1e-9, 12345.678}) {
    for (const Dimension d : {Dimension::none, Dimension::length, Dimension::angle, Dimension::pressure}) {
      EXPECT_EQ(parse_quantity(exact_quantity(value, d), d), value);
    }
  }
  EXPECT_EQ(exact_quantity(0.08, Dimension::length), "0.08 m");
  EXPECT_EQ(short_quantity(0.08, Dimension::length), "80 mm");
  EXPECT_EQ(short_quantity(5e6, Dimension::pressure), "5 MPa");
}

}  // namespace
}  // namespace couloir
