#include <gtest/gtest.h>

#include "convergence.hpp"

namespace couloir::test {
namespace {

// A smooth hump that runs through a periodic channel, against the same run on a much finer grid.
std::vector<double> hump(int n, Limiter limiter, bool relief) {
  SolverSettings s = row(n, 0, 1, Side::Kind::periodic);
  s.limiter = limiter;
  StepBed bed;
  for (int i = 0; relief && i < n; ++i) bed.elevation.push_back(0.02 * std::cos(2 * pi * s.grid.x(i)));
  Solver solver(s, ReferenceSurface::flat(1), bed);
  solver.set([](double x, double) {
    const double h = 0.2 + 0.02 * std::sin(2 * pi * x);
    return FlowState{h, 0.3 * h, 0};
  });
  solver.advance_to(0.15);
  std::vector<double> h;
  for (int i = 0; i < n; ++i) h.push_back(solver.at(i, 0).h);
  return h;
}

double error(const std::vector<double>& coarse, const std::vector<double>& fine) {
  const std::size_t ratio = fine.size() / coarse.size();
  double sum = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    double mean = 0;
    for (std::size_t k = 0; k < ratio; ++k) mean += fine[i * ratio + k];
    sum += std::abs(coarse[i] - mean / static_cast<double>(ratio));
  }
  return sum / static_cast<double>(coarse.size());
}

TEST(Smooth, SecondOrder) {
  for (bool relief : {false, true}) {
    const auto reference = hump(3200, Limiter::mc, relief);
    for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc}) {
      const double e100 = error(hump(100, limiter, relief), reference), e200 = error(hump(200, limiter, relief), reference);
      const double e400 = error(hump(400, limiter, relief), reference);
      std::printf("smooth, limiter %d, relief %d: L1 %.3e %.3e %.3e, orders %.2f %.2f\n", static_cast<int>(limiter), relief, e100,
                  e200, e400, order(e100, e200), order(e200, e400));
      EXPECT_GT(order(e100, e400, 4), limiter == Limiter::minmod ? 1.7 : 1.8);
    }
  }
}

}  // namespace
}  // namespace couloir::test
