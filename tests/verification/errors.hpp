#pragma once
// L1 errors against exact solutions, and against finer runs.

#include <cmath>
#include <vector>

namespace couloir::test {

// In row 0, each divided by the length that it is taken over: mean |h - h_exact| [m], mean |hu - hu_exact| [m2/s].
// exact(x): an object with h and u; counts(x): whether the cell at x takes part.
struct RowError {
  double h = 0, hu = 0;
};
template <class Solver, class Exact, class Counts>
RowError row_error(const Solver& s, Exact&& exact, Counts&& counts) {
  RowError e;
  int cells = 0;
  for (int i = 0; i < s.grid().nx; ++i) {
    const double x = s.grid().x(i);
    if (!counts(x)) continue;
    const auto truth = exact(x);
    const auto is = s.at(i, 0);
    e.h += std::abs(is.h - truth.h);
    e.hu += std::abs(is.hu - truth.h * truth.u);
    ++cells;
  }
  e.h /= cells, e.hu /= cells;
  return e;
}
template <class Solver, class Exact>
RowError row_error(const Solver& s, Exact&& exact) {
  return row_error(s, exact, [](double) { return true; });
}

// Mean distance of a row of cells to the means of a finer one, whose number of cells is a multiple.
inline double error_to_finer(const std::vector<double>& coarse, const std::vector<double>& fine) {
  const std::size_t ratio = fine.size() / coarse.size();
  double sum = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    double mean = 0;
    for (std::size_t k = 0; k < ratio; ++k) mean += fine[i * ratio + k];
    sum += std::abs(coarse[i] - mean / static_cast<double>(ratio));
  }
  return sum / static_cast<double>(coarse.size());
}

// Mean of an exact state over the cell at x, by 32 points: what a cell holds where a shock stands in it.
template <class Exact>
auto cell_mean(Exact&& exact, double x, double dx) {
  constexpr int points = 32;
  auto mean = exact(x);
  double h = 0, hu = 0;
  for (int k = 0; k < points; ++k) {
    const auto q = exact(x + dx * ((k + 0.5) / points - 0.5));
    h += q.h / points, hu += q.h * q.u / points;
  }
  mean.h = h, mean.u = h > 0 ? hu / h : 0.0;
  return mean;
}

// Where the depth along row 0 first crosses `level` when walked from cell `from` towards cell `to` [m]; NaN if it does not.
template <class Solver>
double crossing(const Solver& s, double level, int from, int to) {
  const int step = to > from ? 1 : -1;
  for (int i = from; i != to; i += step) {
    const double a = s.at(i, 0).h, b = s.at(i + step, 0).h;
    if ((a < level) != (b < level)) return s.grid().x(i) + step * s.grid().dx * (level - a) / (b - a);
  }
  return std::nan("");
}

}  // namespace couloir::test
