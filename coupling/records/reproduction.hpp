#pragma once
// Whether a second run of a scene is the first one: to the bit where one build on one kind of machine made both, by a tolerance
// elsewhere.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupling/records/compare.hpp"

namespace couloir {

struct Reproduction {
  enum class Verdict { same_bits, within, differs };

  std::string name;  // of this packing, "seed 7"; empty: there is one
  std::vector<Maker> makers;
  std::string first_difference;  // empty: the same bits
  std::vector<QuantityDifference> quantities;
  bool grains = false;   // there are any: then only what is overall counts against the tolerance
  double tolerance = 0;  // [-]
  bool bits_expected = false;
  std::string summary;  // what is wrong with the first run's summary.json, one sentence; empty: it is of this record

  bool counts(const QuantityDifference& q) const { return q.overall || !grains; }
  bool holds(const QuantityDifference& q) const { return q.relative() <= tolerance; }
  // Other bits by the same build on the same kind of machine are a difference, however small.
  Verdict records_verdict() const;
  Verdict verdict() const;  // with the summary
};

// Where the user gives none: in mode continuum rounding alone, which fronts magnify a little; grains magnify it to where each of
// them is, and leave impulses, masses and volumes.
double default_tolerance(bool grains);

Reproduction reproduction(const RecordsReader& first, const RecordsReader& second, double tolerance);
// The same for the two files of figures, once the records are compared: as strictly as those, where those agree.
void compare_summaries(Reproduction&, const std::string& first, const std::string& second);

const char* to_string(Reproduction::Verdict);
std::string reproduction_text(const Reproduction&);
nlohmann::ordered_json reproduction_json(const Reproduction&);

}  // namespace couloir
