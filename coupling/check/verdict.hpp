#pragma once
// A summary's value against what is expected of it.

#include <string>

#include "coupling/check/expected.hpp"

namespace couloir {

enum class Verdict { pass, fail, shown, skipped };
const char* to_string(Verdict);

struct Finding {
  std::string experiment, name, variant;  // of the case
  Expectation expectation;
  Verdict verdict = Verdict::skipped;
  double value = 0;      // in the expectation's unit; NaN: there is none
  double deviation = 0;  // (value - expected) / |expected| [-]; NaN where the expected value is 0 or there is no value
  std::string reason;    // why there is no value
  std::string command;   // that runs it again; empty for a search
  std::string run;       // folder
};

// Judges `si` (a value in SI) and fills value, deviation and verdict.
void judge(Finding&, double si);

}  // namespace couloir
