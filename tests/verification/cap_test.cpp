#include <gtest/gtest.h>

#include "continuum/exact/parabolic_cap.hpp"
#include "convergence.hpp"

namespace couloir::test {
namespace {

TEST(Cap, ExactGrowth) {  // references.md 2b
  const exact::ParabolicCap cap{1, 1, 1};
  const double g[] = {1.5, 2, 3, 5}, t[] = {0.762252, 1.147794, 1.797853, 2.957886};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(cap.growth(t[k]), g[k], 2e-6);
}

// Spreads while it slides: 35 deg, delta 25 deg, with the active coefficient (the whole cap stretches).
TEST(Cap, SpreadsAsSavageAndHutter) {
  const double zeta = degrees(35), mu = std::tan(degrees(25)), weight = 9.81 * std::cos(zeta);
  const auto run = [&](int n, bool hydraulic) {
    SolverSettings s = row(n, 0, 3, Side::Kind::outflow);
    s.closure = {hydraulic ? EarthPressure::hydraulic() : EarthPressure::active_passive(degrees(40), degrees(25)), mu, true};
    const exact::ParabolicCap cap{0.4, 0.05, s.closure.earth_pressure.x_active * weight};
    Solver solver(s, ReferenceSurface::incline(zeta, 3), {});
    solver.set([&](double x, double) { return FlowState{cap.depth(x - 0.6, 1), 0, 0}; });
    const double t = 0.8, centre = 0.6 + 0.5 * weight * (std::tan(zeta) - mu) * t * t, g = cap.growth(t);
    solver.advance_to(t);
    return depth_error(solver, [&](double x) { return cap.depth(x - centre, g); });
  };
  for (bool hydraulic : {true, false}) {
    const double e150 = run(150, hydraulic), e300 = run(300, hydraulic), e600 = run(600, hydraulic);
    std::printf("cap, hydraulic %d: L1 %.3e %.3e %.3e, orders %.2f %.2f\n", hydraulic, e150, e300, e600, order(e150, e300),
                order(e300, e600));
    EXPECT_GT(order(e150, e600, 4), 0.9);
    EXPECT_LT(e600, 0.01 * 0.4 * 0.05 * 4 / 3);
  }
}

}  // namespace
}  // namespace couloir::test
