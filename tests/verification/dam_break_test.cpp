#include "continuum/exact/dam_break.hpp"

#include "errors.hpp"
#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

template <class S>
class DamBreak : public SchemeTest<S> {};
TYPED_TEST_SUITE(DamBreak, Schemes, SchemeNames);

TYPED_TEST(DamBreak, Ritter) {  // references.md 2d without slope and friction
  Study depth("d", "dam break onto a dry bed (Ritter)", "h [m], L1"),
      momentum("d", "dam break onto a dry bed (Ritter)", "hu [m2/s], L1");
  for (int n : {100, 200, 400, 800}) {
    auto s = TypeParam::make(row<TypeParam>(n, -1, 2, Side::Kind::outflow), ReferenceSurface::flat(2));
    s.set([](double x, double) { return FlowState{x < 0 ? 0.1 : 0.0, 0, 0}; });
    s.advance_to(0.3);
    const auto e = row_error(s, [](double x) { return exact::dam_break_dry(x, 0.3, 0.1, 9.81); });
    depth.add(n, e.h);
    momentum.add(n, e.hu);
  }
  depth.expect_order(TypeParam::order_shock);
  momentum.expect_order(TypeParam::order_shock);
}

// The errors are means over the time in which the shock crosses one cell: where in a cell it stands makes a difference of half.
TYPED_TEST(DamBreak, Stoker) {
  const exact::StokerDamBreak stoker(0.1, 0.02, 9.81);
  const double t = 0.5, behind = stoker.at(stoker.shock_speed() * t * 0.99, t).h;
  Study depth("d", "dam break onto a layer (Stoker)", "h [m], L1"),
      momentum("d", "dam break onto a layer (Stoker)", "hu [m2/s], L1");
  Study place("d", "dam break onto a layer (Stoker)", "place of the shock [cells], error");
  for (int n : {100, 200, 400, 800}) {
    auto s = TypeParam::make(row<TypeParam>(n, -1, 2, Side::Kind::outflow), ReferenceSurface::flat(2));
    s.set([](double x, double) { return FlowState{x < 0 ? 0.1 : 0.02, 0, 0}; });
    RowError e;
    double off = 0;
    constexpr int times = 8;
    for (int k = 0; k < times; ++k) {
      const double now = t + k * s.grid().dx / (times * stoker.shock_speed()), shock = stoker.shock_speed() * now;
      s.advance_to(now);
      const auto one =
          row_error(s, [&](double x) { return cell_mean([&](double at) { return stoker.at(at, now); }, x, s.grid().dx); });
      e.h += one.h / times, e.hu += one.hu / times;
      off = std::max(off, std::abs(crossing(s, 0.5 * (0.02 + behind), n - 1, 0) - shock) / s.grid().dx);
    }
    depth.add(n, e.h);
    momentum.add(n, e.hu);
    place.add(n, off);
  }
  depth.expect_order(TypeParam::order_shock);
  momentum.expect_order(TypeParam::order_shock);
  place.expect_below(1);
}

// 30 deg, delta 22 deg, clear of the tail at the upper end, which the exact solution does not have.
TYPED_TEST(DamBreak, OnAnInclineWithFriction) {
  const double zeta = degrees(30), mu = std::tan(degrees(22)), g = 9.81 * std::cos(zeta), m = g * (std::tan(zeta) - mu);
  const std::string name = "dam break on an incline, zeta 30, delta 22";
  Study depth("d", name, "h [m], L1"), momentum("d", name, "hu [m2/s], L1");
  for (int n : {400, 800, 1600, 3200}) {
    SolverSettings settings = row<TypeParam>(n, -2, 4, Side::Kind::outflow);
    settings.closure.tan_delta = mu;
    auto s = TypeParam::make(settings, ReferenceSurface::incline(zeta, 4));
    s.set([](double x, double) { return FlowState{x < 0 ? 0.1 : 0.0, 0, 0}; });
    s.advance_to(0.5);
    const auto exact = [&](double x) { return exact::dam_break_dry(x, 0.5, 0.1, g, m); };
    const auto e = row_error(s, exact, [](double x) { return x > -0.9; });
    depth.add(n, e.h);
    momentum.add(n, e.hu);
    if (n == 400) {
      std::vector<std::vector<double>> rows;
      for (int i = 0; i < n; ++i) rows.push_back({s.grid().x(i), s.at(i, 0).h, exact(s.grid().x(i)).h});
      record_profile(std::string("incline_dam_break_") + TypeParam::name, "x,h,exact", rows);
    }
  }
  depth.expect_order(TypeParam::order_shock);
  momentum.expect_order(TypeParam::order_shock);
}

}  // namespace
}  // namespace couloir::test
