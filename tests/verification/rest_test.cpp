#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

// references.md 2h; more shapes of it in tests/continuum/rest_test.cpp.
template <class S>
class Rest : public SchemeTest<S> {
 public:
  // Greatest change of depth [m] or momentum [m2/s] after 200 steps.
  template <class Solver>
  static double departure(Solver& s) {
    std::vector<double> h0, h, hu, hv;
    s.gather(h0, hu, hv);
    for (int k = 0; k < 200; ++k) s.step(s.stable_dt());
    s.gather(h, hu, hv);
    double most = 0;
    for (std::size_t k = 0; k < h.size(); ++k) most = std::max({most, std::abs(h[k] - h0[k]), std::abs(hu[k]), std::abs(hv[k])});
    return most;
  }
};
TYPED_TEST_SUITE(Rest, Schemes, SchemeNames);

TYPED_TEST(Rest, LakeWithAnIsland) {
  if (!TypeParam::keeps_lakes) GTEST_SKIP() << "not a scheme that keeps a lake at rest over a bed; the next case tells how near";
  for (Limiter limiter : {TypeParam::plain, TypeParam::smooth}) {
    SolverSettings s = basin(50, 36, 0.04);
    s.limiter = limiter;
    const auto ground = [](double x, double y) { return 0.3 * std::exp(-8 * ((x - 1) * (x - 1) + y * y)); };
    auto solver = TypeParam::make(s, ReferenceSurface::flat(2), ground);
    solver.set([&](double x, double y) { return FlowState{std::max(0.0, 0.2 - ground(x, y)), 0, 0}; });
    Study study("h", "lake at rest round an island", "greatest change of h, hu, hv");
    study.add(50, this->departure(solver));
    study.expect_below(1e-13);
  }
}

// Over a hill under water, after two waves' way over it: nothing, or what falls with the order of the scheme.
TYPED_TEST(Rest, LakeOverAHill) {
  const auto ground = [](double x, double) { return 0.1 * std::exp(-8 * (x - 1) * (x - 1)); };
  Study study("h", "lake over a hill under water", "change of h [m], L1");
  for (int n : {50, 100, 200, 400}) {
    auto solver = TypeParam::make(row<TypeParam>(n, 0, 2, Side::Kind::wall), ReferenceSurface::flat(2), ground);
    solver.set([&](double x, double y) { return FlowState{0.2 - ground(x, y), 0, 0}; });
    solver.advance_to(1);
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += std::abs(solver.at(i, 0).h - (0.2 - ground(solver.grid().x(i), 0))) / n;
    study.add(n, sum);
  }
  if (TypeParam::keeps_lakes) {
    study.expect_below(1e-15);
  } else {
    study.expect_order(TypeParam::order_smooth);
  }
}

// A cone on a slope, its sides at 98 % of what friction holds.
TYPED_TEST(Rest, PileBelowYield) {
  SolverSettings s;
  s.grid = {80, 60, 0.02, 0.02, 0, -0.6};
  s.closure = quartz();
  s.limiter = TypeParam::plain;
  const EarthPressure& k = s.closure.earth_pressure;
  const double slope = 0.98 * (std::tan(degrees(28)) - std::tan(degrees(15))) / std::max({k.x_active, k.y_active_active});
  auto solver = TypeParam::make(s, ReferenceSurface::incline(degrees(15), 1.6));
  solver.set([&](double x, double y) { return FlowState{std::max(0.0, slope * (0.5 - std::hypot(x - 0.8, y))), 0, 0}; });
  Study study("h", "pile at 98 % of yield, zeta 15, delta 28", "greatest change of h, hu, hv");
  study.add(80, this->departure(solver));
  study.expect_zero();
}

}  // namespace
}  // namespace couloir::test
