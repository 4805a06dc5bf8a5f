#pragma once
// Two records of one scene beside each other: what made them, whether their bits are the same, and by how much they differ.

#include <limits>
#include <string>
#include <vector>

#include "coupling/records/reader.hpp"

namespace couloir {

// What differs between two runs' numbers (windows, forces, frames, events' times), bit for bit: the first place and both values,
// or an empty text where they are the same. Attributes such as the start time are not compared.
std::string first_difference(const RecordsReader& a, const RecordsReader& b);

// A quantity of both runs at its worst: the largest |a - b|, over the largest that either of them has met.
struct QuantityDifference {
  std::string name, unit;                                  // "force on wall", "N"
  double largest = 0;                                      // [unit] NaN: only one of the two has it
  double scale = 0;                                        // [unit]
  double time = std::numeric_limits<double>::quiet_NaN();  // [s] when; NaN: of the run as a whole
  // Impulses, masses and where the volume lies. Other than single windows they hardly depend on where each grain is, so that
  // two runs may be held against each other by them although grains magnify a rounding without bounds.
  bool overall = false;
  double relative() const;  // 0 where there is nothing to differ
  bool same_bits = true;
};

// Forces, gauges, stresses and measures by window; the last depth field that both have; the mass and the momentum ledger.
std::vector<QuantityDifference> differences(const RecordsReader& a, const RecordsReader& b);

// What a record says of the program and the machine that made it.
struct Maker {
  std::string what, first, second;  // "compiler", of either run; empty: not recorded
  // Threads and ranks of the continuum: any number gives the same bits.
  bool matters = true;
};
std::vector<Maker> makers(const RecordsReader& a, const RecordsReader& b);

// Whether both were made by one build on one kind of machine.
bool same_makers(const std::vector<Maker>&);

}  // namespace couloir
