#include "coupling/check/verdict.hpp"

#include <cmath>
#include <limits>

namespace couloir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "FAIL";
    case Verdict::shown:
      return "shown";
    case Verdict::skipped:
      return "skipped";
  }
  return "?";
}

void judge(Finding& f, double si) {
  const Expectation& e = f.expectation;
  f.value = si / e.unit.si;
  const double off = f.value - e.value;
  f.deviation = e.value == 0 ? nan : off / std::abs(e.value);
  switch (e.tolerance.kind) {
    case Tolerance::Kind::none:
      f.verdict = Verdict::shown;
      break;
    case Tolerance::Kind::relative:  // a NaN compares false: fail
      f.verdict = std::abs(off) <= e.tolerance.size * std::abs(e.value) ? Verdict::pass : Verdict::fail;
      break;
    case Tolerance::Kind::absolute:
      f.verdict = std::abs(off) <= e.tolerance.size ? Verdict::pass : Verdict::fail;
      break;
  }
  if (std::isnan(f.value)) f.reason = "the run has no such value (null)";
}

}  // namespace couloir
