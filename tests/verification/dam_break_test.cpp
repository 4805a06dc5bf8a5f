#include "continuum/exact/dam_break.hpp"

#include <gtest/gtest.h>

#include "convergence.hpp"

namespace couloir::test {
namespace {

TEST(DamBreak, RitterConverges) {
  const auto error = [](int n) {
    Solver s(row(n, -1, 2, Side::Kind::outflow), ReferenceSurface::flat(2), {});
    s.set([](double x, double) { return FlowState{x < 0 ? 0.1 : 0.0, 0, 0}; });
    s.advance_to(0.3);
    return depth_error(s, [](double x) { return exact::dam_break_dry(x, 0.3, 0.1, 9.81).h; });
  };
  const double e100 = error(100), e200 = error(200), e400 = error(400), e800 = error(800);
  RecordProperty("order", std::to_string(order(e400, e800)));
  std::printf("Ritter: L1 %.3e %.3e %.3e %.3e, orders %.2f %.2f %.2f\n", e100, e200, e400, e800, order(e100, e200),
              order(e200, e400), order(e400, e800));
  EXPECT_GT(order(e100, e800, 8), 0.85);
  EXPECT_LT(e800, 0.002 * 0.1);
}

TEST(DamBreak, StokerConverges) {
  const exact::StokerDamBreak stoker(0.1, 0.02, 9.81);
  const auto error = [&](int n) {
    Solver s(row(n, -1, 2, Side::Kind::outflow), ReferenceSurface::flat(2), {});
    s.set([](double x, double) { return FlowState{x < 0 ? 0.1 : 0.02, 0, 0}; });
    s.advance_to(0.5);
    return depth_error(s, [&](double x) { return stoker.at(x, 0.5).h; });
  };
  const double e100 = error(100), e200 = error(200), e400 = error(400), e800 = error(800);
  std::printf("Stoker: L1 %.3e %.3e %.3e %.3e, orders %.2f %.2f %.2f\n", e100, e200, e400, e800, order(e100, e200),
              order(e200, e400), order(e400, e800));
  EXPECT_GT(order(e100, e800, 8), 0.85);
  EXPECT_LT(e800, 0.002 * 0.1);
}

// references.md 2d: 30 deg, delta 22 deg.
TEST(DamBreak, OnAnInclineWithFrictionConverges) {
  const double zeta = degrees(30), mu = std::tan(degrees(22)), g = 9.81 * std::cos(zeta), m = g * (std::tan(zeta) - mu);
  const auto error = [&](int n) {
    SolverSettings settings = row(n, -2, 4, Side::Kind::outflow);
    settings.closure.tan_delta = mu;
    Solver s(settings, ReferenceSurface::incline(zeta, 4), {});
    s.set([](double x, double) { return FlowState{x < 0 ? 0.1 : 0.0, 0, 0}; });
    s.advance_to(0.5);
    double sum = 0;  // clear of the tail at the upper end, which the exact solution does not have
    for (int i = 0; i < n; ++i) {
      const double x = s.grid().x(i);
      if (x > -0.9) sum += std::abs(s.at(i, 0).h - exact::dam_break_dry(x, 0.5, 0.1, g, m).h) * s.grid().dx;
    }
    return sum;
  };
  const double e200 = error(200), e400 = error(400), e800 = error(800);
  std::printf("Incline: L1 %.3e %.3e %.3e, orders %.2f %.2f\n", e200, e400, e800, order(e200, e400), order(e400, e800));
  EXPECT_GT(order(e200, e800, 4), 0.85);
  EXPECT_LT(e800, 0.004 * 0.1);
}

}  // namespace
}  // namespace couloir::test
