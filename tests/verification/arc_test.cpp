#include "continuum/exact/steady_chute.hpp"
#include "errors.hpp"
#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

constexpr double slope = 0.5, arc = 0.6, runout = 0.4, total = slope + arc + runout;

exact::SteadyChute chute(double h, double u, bool curvature) {
  return {degrees(40), slope, arc, 9.81, std::tan(degrees(20)), 1, h, u, curvature};
}

// A layer without thickness over the whole arc has a closed solution.
TEST(ArcReference, AgreesWithTheClosedSolutionOfAThinLayer) {
  const auto thin = chute(1e-12, 3, true);
  for (double x : {0.6, 0.8, 1.1}) {
    const double zeta = degrees(40) * (1 - (x - slope) / arc);
    EXPECT_NEAR(thin.at(x).u, thin.thin_velocity(zeta, thin.at(slope).u), 1e-9) << x;
  }
}

template <class S>
class Arc : public SchemeTest<S> {
 public:
  static auto steady(int n, const exact::SteadyChute& c) {
    SolverSettings s = row<S>(n, 0, total, Side::Kind::outflow);
    s.sides[0] = {Side::Kind::inflow, c.inflow_h, c.inflow_u};
    s.closure = {EarthPressure::hydraulic(), c.mu, c.curvature};
    s.gravity = c.gravity;
    auto solver = S::make(s, ReferenceSurface::chute(c.angle, c.slope, c.arc, runout));
    const auto exact = [&](double x, double) {
      const auto q = c.at(x);
      return FlowState{q.h, q.h * q.u, 0};
    };
    solver.set(exact);
    const double end = 3 * total / c.inflow_u;
    if (S::held == 0) solver.advance_to(end);
    while (solver.time() < end) {
      for (int i = 0; i < S::held; ++i) solver.set(i, 0, exact(s.grid.x(i), 0));
      solver.step(solver.stable_dt());
    }
    return solver;
  }
};
TYPED_TEST_SUITE(Arc, AllSchemes, SchemeNames);

// references.md 2i: a steady layer down incline, arc and run-out, of finite thickness and thin.
TYPED_TEST(Arc, SteadyLayer) {
  for (double h : {0.02, 0.001}) {
    const auto reference = chute(h, 3, true);
    const std::string name = "layer of " + std::to_string(static_cast<int>(1000 * h)) + " mm round an arc, zeta 40, delta 20";
    Study depth("i", name, "h [m], L1"), velocity("i", name, "u [m/s], L1");
    for (int n : {75, 150, 300, 600}) {
      const auto s = this->steady(n, reference);
      const auto e = row_error(s, [&](double x) { return reference.at(x); });
      depth.add(n, e.h);
      double off = 0;
      for (int i = 0; i < n; ++i) off += std::abs(s.at(i, 0).hu / s.at(i, 0).h - reference.at(s.grid().x(i)).u) / n;
      velocity.add(n, off);
      if (n == 75 && h > 0.01) {
        const auto without = chute(h, 3, false);
        std::vector<std::vector<double>> rows;
        for (int i = 0; i < n; ++i) {
          const double x = s.grid().x(i);
          rows.push_back({x, s.at(i, 0).hu / s.at(i, 0).h, reference.at(x).u, without.at(x).u});
        }
        record_profile(std::string("arc_") + TypeParam::name, "x,u,exact,without", rows);
      }
    }
    if (TypeParam::ripples) {
      depth.expect_below(0.01 * h);
      velocity.expect_below(0.001 * reference.inflow_u);
    } else {
      depth.expect_order(TypeParam::order_smooth);
      velocity.expect_order(TypeParam::order_smooth);
    }
  }
}

// The curvature alone, gravity all but off: an arc of 40 deg leaves exp(-mu zeta) of the velocity.
TYPED_TEST(Arc, CurvatureAlone) {
  Study study("i", "arc without weight", "velocity behind the arc, relative error");
  for (int n : {75, 150, 300}) {
    exact::SteadyChute c = chute(0.01, 5, true);
    c.gravity = 1e-9;
    const auto s = this->steady(n, c);
    study.add(n, std::abs(s.at(13 * n / 15, 0).hu / s.at(13 * n / 15, 0).h / (5 * std::exp(-c.mu * degrees(40))) - 1));
  }
  if (TypeParam::bounds_speed) {
    study.expect_below(0.001);
  } else {
    study.expect_order(TypeParam::order_smooth);
  }
}

// Over a brink the curvature lifts the layer: w = u^2 of a thin one follows dw/dx = 2 g sin(zeta) - 2 mu max(0, g cos(zeta) +
// kappa w), integrated here by Runge-Kutta of order 4. At 1 m/s some weight is left; at 5 m/s none, and nothing brakes it on the
// brink.
TYPED_TEST(Arc, ThinLayerOverABrink) {
  const double mu = std::tan(degrees(20)), g = 9.81, length = 1.5;
  const auto surface =
      ReferenceSurface::profile({{0, degrees(30)}, {0.5, degrees(30)}, {0.9, degrees(55)}, {length, degrees(55)}});
  for (double u : {1.0, 5.0}) {
    double w = u * u;
    const int steps = 30000;
    const double dx = length / steps;
    const auto slope_of = [&](double x, double at) {
      return 2 * g * std::sin(surface.angle(x)) -
             2 * mu * std::max(0.0, g * std::cos(surface.angle(x)) + surface.curvature(x) * at);
    };
    for (int n = 0; n < steps; ++n) {
      const double x = n * dx, a = slope_of(x, w), b = slope_of(x + dx / 2, w + dx / 2 * a),
                   c = slope_of(x + dx / 2, w + dx / 2 * b), d = slope_of(x + dx, w + dx * c);
      w += dx / 6 * (a + 2 * b + 2 * c + d);
    }
    Study study("i", "thin layer over a brink at " + std::to_string(int(u)) + " m/s", "velocity at the end, relative error");
    for (int n : {75, 150, 300}) {
      SolverSettings s = row<TypeParam>(n, 0, length, Side::Kind::outflow);
      s.sides[0] = {Side::Kind::inflow, 1e-4, u};
      s.closure = {EarthPressure::hydraulic(), mu, true};
      s.gravity = g;
      auto solver = TypeParam::make(s, surface);
      solver.set([&](double, double) { return FlowState{1e-4, 1e-4 * u, 0}; });
      const double end = 3 * length / u;
      if (TypeParam::held == 0) solver.advance_to(end);
      while (solver.time() < end) {
        for (int i = 0; i < TypeParam::held; ++i)
          solver.set(i, 0, {1e-4, 1e-4 * std::sqrt(u * u + s.grid.x(i) * slope_of(0.1, u * u)), 0});
        solver.step(solver.stable_dt());
      }
      // What the last cell still gains over its second half belongs to the end.
      const auto last = solver.at(n - 1, 0);
      const double at_end = std::pow(last.hu / last.h, 2) + slope_of(length - 1e-9, w) * s.grid.dx / 2;
      study.add(n, std::abs(std::sqrt(at_end / w) - 1));
    }
    // The last cell is what is read: there central_upwind's outflow is of first order.
    if (std::is_same_v<TypeParam, CentralUpwind>) {
      study.expect_order(0.9);
    } else {
      study.expect_below(0.002);
    }
  }
}

}  // namespace
}  // namespace couloir::test
