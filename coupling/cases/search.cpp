#include "coupling/cases/search.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace couloir {
namespace {

// Steps such as 0.1 do not add up exactly; the text is what the file would say.
std::string value_text(const Search& search, double value) {
  return fmt::format("{:.10g}{}{}", value, search.unit.empty() ? "" : " ", search.unit);
}

long steps_of(const Search& search) {
  return std::lround(std::floor((search.to - search.from) / search.step + 1e-9));
}

}  // namespace

double Search::last() const {
  return from + static_cast<double>(steps_of(*this)) * step;
}

int Search::most_runs() const {
  int runs = 1;
  for (long span = steps_of(*this) + 1; span > 1; span -= span / 2) ++runs;
  return runs;
}

std::string filled(const std::string& form, const std::string& text) {
  const auto at = form.find("{}");
  return at == std::string::npos ? text : form.substr(0, at) + text + form.substr(at + 2);
}

Overrides with_value(Overrides set, const Search& search, double value) {
  set.emplace_back(search.key, filled(search.form, value_text(search, value)));
  return set;
}

double smallest_good(const Search& search, const std::function<bool(double)>& good) {
  const auto at = [&](long n) { return search.from + static_cast<double>(n) * search.step; };
  long good_at = steps_of(search), bad_at = -1;
  if (!good(at(good_at))) return std::numeric_limits<double>::quiet_NaN();
  while (good_at - bad_at > 1) {
    const long middle = bad_at + (good_at - bad_at) / 2;
    (good(at(middle)) ? good_at : bad_at) = middle;
  }
  return at(good_at);
}

SearchResult search_critical(const Search& search, const std::function<double(double)>& quantity,
                             const std::function<std::string()>& failed) {
  SearchResult out;
  out.critical =
      smallest_good(search, [&](double at) { return failed().empty() && quantity(at) <= search.bound * search.bound_unit.si; });
  if (std::isnan(out.critical) && failed().empty()) {
    const double low = quantity(search.from), high = failed().empty() ? quantity(search.last()) : low;
    if (failed().empty()) out.failure = why_none_is_good(search, low, high);
  }
  if (out.critical == search.from)
    out.remark = fmt::format("{} is good already, the lowest that the search tries: the critical value may be less",
                             value_text(search, search.from));
  if (const std::string reason = failed(); !reason.empty()) {
    out.failure = reason;
    out.critical = std::numeric_limits<double>::quiet_NaN();
  }
  return out;
}

std::string why_none_is_good(const Search& search, double low, double high) {
  const auto seen = [&](double si, double at) {
    const std::string value = std::isnan(si) ? "null" : with_unit(si / search.bound_unit.si, search.bound_unit);
    return fmt::format("{} at {}", value, value_text(search, at));
  };
  const bool rises = low <= search.bound * search.bound_unit.si;
  return fmt::format("{} is {} and {} of {}: {} its bound of {}{}", search.quantity, seen(low, search.from),
                     seen(high, search.last()), search.key, rises ? "only the upper end misses" : "both ends miss",
                     with_unit(search.bound, search.bound_unit),
                     rises ? ", but a search needs a quantity that falls as the key rises" : "; search elsewhere");
}

}  // namespace couloir
