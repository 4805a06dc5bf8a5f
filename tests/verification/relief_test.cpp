#include "convergence.hpp"
#include "errors.hpp"
#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

template <class S>
class Relief : public SchemeTest<S> {
 public:
  // A smooth hump that runs over a wavy bed in a periodic channel.
  static std::vector<double> hump(int n, Limiter limiter) {
    SolverSettings s = row<S>(n, 0, 1, Side::Kind::periodic);
    s.limiter = limiter;
    auto solver = S::make(s, ReferenceSurface::flat(1), [](double x, double) { return 0.02 * std::cos(2 * pi * x); });
    solver.set([](double x, double) {
      const double h = 0.2 + 0.02 * std::sin(2 * pi * x);
      return FlowState{h, 0.3 * h, 0};
    });
    solver.advance_to(0.15);
    std::vector<double> h, hu, hv;
    solver.gather(h, hu, hv);
    return h;
  }
};
TYPED_TEST_SUITE(Relief, Schemes, SchemeNames);

// There is no closed solution: against the same run on a much finer grid.
TYPED_TEST(Relief, IsOfSecondOrder) {
  const auto reference = this->hump(3200, Limiter::mc);
  for (Limiter limiter : TypeParam::limiters) {
    Study study("smooth", "hump over a wavy bed, " + limiter_name(limiter), "h [m], L1 to 3200 cells");
    for (int n : {100, 200, 400}) study.add(n, error_to_finer(this->hump(n, limiter), reference));
    study.expect_order(TypeParam::order_smooth);
  }
}

}  // namespace
}  // namespace couloir::test
