#pragma once
// The smallest value of a key for which a quantity stays at or below a bound, found by halving.

#include <functional>
#include <string>

#include "coupling/cases/case_unit.hpp"
#include "coupling/scene/reader.hpp"

namespace couloir {

// The quantity must fall as the value rises: then bad values lie below good ones.
struct Search {
  std::string key, form;  // override; form: the value's text, {} stands for the number
  double from = 0, to = 0, step = 0;
  std::string unit;      // written after the number; empty: a bare number
  std::string quantity;  // path into summary.json
  double bound = 0;      // in bound_unit
  CaseUnit bound_unit;

  double last() const;    // the grid's highest value
  int most_runs() const;  // that halving needs
};

// A form such as "[4, {}]" with the text in its place.
std::string filled(const std::string& form, const std::string& text);

// What the search sets at this value, after the others.
Overrides with_value(Overrides, const Search&, double value);

// The value of a search: the first n on the grid from, from + step, ... with good(n), found by halving; NaN where the last is
// not good.
double smallest_good(const Search&, const std::function<bool(double value)>& good);

// What a search came to.
struct SearchResult {
  double critical = 0;  // NaN: none
  std::string failure;  // why there is none
  std::string remark;   // that the lowest value is good already, so that the critical one may lie below it
};

// Halves with the quantity in SI (NaN: null) at each value, until `failed()` gives a reason. Where no value is good it looks at
// both ends, so that the reason tells a wrong bracket from a quantity that rises.
SearchResult search_critical(const Search&, const std::function<double(double value)>& quantity,
                             const std::function<std::string()>& failed);

// Why there is none, from the quantity (SI; NaN: null) at the search's lowest and highest value.
std::string why_none_is_good(const Search&, double low, double high);

}  // namespace couloir
