#include "continuum/exact/sliding_slab.hpp"
#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

template <class S>
class Slab : public SchemeTest<S> {
 public:
  static auto slab(double zeta, double delta, double u0) {
    SolverSettings s = row<S>(20, 0, 2, Side::Kind::periodic);
    s.closure = {EarthPressure::active_passive(degrees(40), degrees(28)), std::tan(delta), true};
    auto solver = S::make(s, ReferenceSurface::incline(zeta, 2));
    solver.set([&](double, double) { return FlowState{0.1, 0.1 * u0, 0}; });
    return solver;
  }
};
TYPED_TEST_SUITE(Slab, Schemes, SchemeNames);

// references.md 2a: speeding up without friction and with it, slowing down.
TYPED_TEST(Slab, SlidesToRoundOff) {
  for (double delta : {0.0, 20.0, 40.0}) {
    const double zeta = degrees(30), mu = std::tan(degrees(delta));
    Study study("a", "sliding slab, zeta 30, delta " + std::to_string(static_cast<int>(delta)), "hu [m2/s], error");
    auto s = this->slab(zeta, degrees(delta), 2);
    s.advance_to(0.5);
    study.add(20, std::abs(s.at(7, 0).hu - 0.1 * exact::sliding_slab_velocity(0.5, 2, 9.81, zeta, mu)));
    study.expect_below(1e-13);
    EXPECT_NEAR(s.at(7, 0).h, 0.1, 1e-14);
  }
}

TYPED_TEST(Slab, StopsAndStaysStopped) {
  auto s = this->slab(degrees(20), degrees(28), 0.5);
  s.advance_to(1);
  EXPECT_EQ(s.max_speed(), 0);
  EXPECT_NEAR(s.at(7, 0).h, 0.1, 1e-14);
}

}  // namespace
}  // namespace couloir::test
