#include "continuum/exact/depth_velocity.hpp"
#include "continuum/exact/parabolic_cap.hpp"
#include "errors.hpp"
#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

template <class S>
class Cap : public SchemeTest<S> {};
TYPED_TEST_SUITE(Cap, AllSchemes, SchemeNames);

// The active coefficient whatever the flow does.
EarthPressure all_active(const EarthPressure& k) {
  const double x = k.x_active, y = k.y_active_active;
  return {x, x, y, y, y, y};
}

TEST(CapTable, ExactGrowth) {  // references.md 2b
  const exact::ParabolicCap cap{1, 1, 1};
  const double g[] = {1.5, 2, 3, 5}, t[] = {0.762252, 1.147794, 1.797853, 2.957886};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(cap.growth(t[k]), g[k], 2e-6);
}

// Spreads while it slides: 35 deg, delta 20 deg, hydraulic or with the active coefficient (the whole cap stretches). Of the whole
// cap the two fronts are no smoother than a kink. The part that no wave from a front has reached yet is |xi| < L sqrt(G).
TYPED_TEST(Cap, SpreadsAsSavageAndHutter) {
  const double zeta = degrees(35), mu = std::tan(degrees(20)), weight = 9.81 * std::cos(zeta), t = 0.8;
  for (bool hydraulic : {true, false}) {
    const std::string name = std::string("parabolic cap, ") + (hydraulic               ? "K = 1"
                                                               : TypeParam::switches_k ? "K active, given"
                                                                                       : "K active");
    Study whole("b", name, "h [m], L1"), momentum("b", name, "hu [m2/s], L1"),
        inside("b", name, "h [m], L1 before the fronts' waves");
    for (int n : {300, 600, 1200, 2400}) {
      SolverSettings s = row<TypeParam>(n, 0, 3, Side::Kind::outflow);
      s.closure = {hydraulic ? EarthPressure::hydraulic() : EarthPressure::active_passive(degrees(40), degrees(20)), mu, true};
      if (!hydraulic && TypeParam::switches_k) s.closure.earth_pressure = all_active(s.closure.earth_pressure);
      const exact::ParabolicCap cap{0.4, 0.05, s.closure.earth_pressure.x_active * weight};
      const double drive = weight * (std::tan(zeta) - mu), centre = 0.6 + 0.5 * drive * t * t, g = cap.growth(t);
      auto solver = TypeParam::make(s, ReferenceSurface::incline(zeta, 3));
      solver.set([&](double x, double) { return FlowState{cap.depth(x - 0.6, 1), 0, 0}; });
      const double volume = solver.volume();
      solver.advance_to(t);
      EXPECT_NEAR(solver.volume(), volume, 1e-13 * volume);
      const auto exact = [&](double x) {
        return exact::DepthVelocity{cap.depth(x - centre, g), drive * t + cap.spreading(x - centre, g)};
      };
      const auto e = row_error(solver, exact);
      whole.add(n, e.h);
      momentum.add(n, e.hu);
      inside.add(n, row_error(solver, exact, [&](double x) { return std::abs(x - centre) < 0.8 * cap.length * std::sqrt(g); }).h);
    }
    whole.expect_order(TypeParam::order_shock);
    momentum.expect_order(TypeParam::order_shock);
    inside.expect_order(TypeParam::order_crest);
  }
}

}  // namespace
}  // namespace couloir::test
