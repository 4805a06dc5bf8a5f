#pragma once
// "80 mm" -> 0.08: quantities with units, and the seed's scales (2.47) for bare numbers.

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace couloir {

enum class Dimension { none, length, time, velocity, acceleration, time_per_velocity, mass, density, pressure, angle };

// "a length", "a number"; for messages.
const char* describe(Dimension);
// The units that may be written, the SI unit first; empty for Dimension::none.
std::vector<std::string> units_of(Dimension);
// "m"; empty for Dimension::none.
std::string si_unit(Dimension);

// What a bare number is a multiple of, by (2.47): length L, time sqrt(L/g), velocity sqrt(L g), their ratio 1/g, mass rho L^3,
// pressure rho g L. length = 0: no scales, bare numbers are SI. Accelerations and densities are SI in either case: they define
// the scales.
struct Scales {
  double length = 0;   // [m]
  double gravity = 0;  // [m/s2]
  double density = 0;  // [kg/m3] bulk
  double of(Dimension) const;
};

// The text is no quantity of the dimension asked for. what() goes on from the key's name: "is '80 kg', but ...".
struct QuantityError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// A finite number with an optional unit, in SI. A bare angle other than 0 is refused: 40 may be meant in degrees.
double parse_quantity(std::string_view text, Dimension, const Scales& = {});

// "0.08 m": the shortest text that parse_quantity reads back to the same bits.
std::string exact_quantity(double value, Dimension);
// "80 mm", "40 deg": short, for people.
std::string short_quantity(double value, Dimension);

}  // namespace couloir
