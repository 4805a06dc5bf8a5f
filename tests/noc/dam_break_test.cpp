#include "continuum/exact/dam_break.hpp"

#include <gtest/gtest.h>

#include "noc_scenes.hpp"

namespace couloir::test {
namespace {

NocSolver dam_break(int n, double below, double t, Limiter limiter = Limiter::minmod) {
  SolverSettings settings = row(n, -1, 2, Side::Kind::outflow);
  settings.limiter = limiter;
  NocSolver s(settings, ReferenceSurface::flat(2), {});
  s.set([=](double x, double) { return FlowState{x < 0 ? 0.1 : below, 0, 0}; });
  s.advance_to(t);
  return s;
}

TEST(NocDamBreak, RitterConvergesOnADryBed) {
  for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee, Limiter::eno}) {
    const auto error = [&](int n) {
      const NocSolver s = dam_break(n, 0, 0.3, limiter);
      EXPECT_GE(s.min_depth(), 0);
      EXPECT_EQ(s.budget().mass_clipped, 0);
      return depth_error(s, [](double x) { return exact::dam_break_dry(x, 0.3, 0.1, 9.81).h; });
    };
    const double e100 = error(100), e200 = error(200), e400 = error(400), e800 = error(800);
    std::printf("noc Ritter %d: L1 %.3e %.3e %.3e %.3e, orders %.2f %.2f %.2f\n", static_cast<int>(limiter), e100, e200, e400,
                e800, order(e100, e200), order(e200, e400), order(e400, e800));
    EXPECT_GT(order(e100, e800, 8), 0.8);
    EXPECT_LT(e800, 0.004 * 0.1);
  }
}

TEST(NocDamBreak, StokerConvergesAndHasItsShockInPlace) {
  const exact::StokerDamBreak stoker(0.1, 0.02, 9.81);
  for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee, Limiter::eno}) {
    const auto error = [&](int n) {
      return depth_error(dam_break(n, 0.02, 0.5, limiter), [&](double x) { return stoker.at(x, 0.5).h; });
    };
    const double e100 = error(100), e200 = error(200), e400 = error(400), e800 = error(800);
    const NocSolver s = dam_break(800, 0.02, 0.5, limiter);
    const double exact_shock = 0.5 * stoker.shock_speed();
    const double mid = 0.5 * (stoker.at(exact_shock - 1e-6, 0.5).h + 0.02);
    double shock = 0;
    for (int i = 799; i > 0 && shock == 0; --i) {
      const double a = s.at(i - 1, 0).h, b = s.at(i, 0).h;
      if (a >= mid && b < mid) shock = s.grid().x(i - 1) + s.grid().dx * (a - mid) / (a - b);
    }
    std::printf("noc Stoker %d: L1 %.3e %.3e %.3e %.3e, orders %.2f %.2f %.2f; shock %.5f (%.5f)\n", static_cast<int>(limiter),
                e100, e200, e400, e800, order(e100, e200), order(e200, e400), order(e400, e800), shock, exact_shock);
    EXPECT_NEAR(shock, exact_shock, s.grid().dx);
    EXPECT_GT(order(e100, e800, 8), 0.8);
  }
}

}  // namespace
}  // namespace couloir::test
