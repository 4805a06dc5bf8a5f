#include <algorithm>

#include "continuum/exact/depth_velocity.hpp"
#include "continuum/exact/normal_shock.hpp"
#include "errors.hpp"
#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

TEST(WallShockTable, ExactRatios) {  // references.md 2f
  const double froude[] = {1, 2, 3, 5, 7}, eta[] = {2.170086, 3.493959, 4.863990, 7.649775, 10.457629};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(exact::normal_shock_depth_ratio(froude[k]), eta[k], 5e-7);
}

template <class S>
class WallShock : public SchemeTest<S> {};
TYPED_TEST_SUITE(WallShock, Schemes, SchemeNames);

// A uniform flow on a slope with delta = zeta runs against a wall, the domain's side or a step obstacle. Behind the shock the
// material is at rest and held. The force is the mean while the shock runs from 0.6 to 1.2 m.
TYPED_TEST(WallShock, DepthPlaceAndForce) {
  for (bool obstacle : {false, true}) {
    for (double froude : {1.0, 2.0, 3.0, 5.0, 7.0}) {
      const double zeta = degrees(30), g = 9.81 * std::cos(zeta), h1 = 0.05, u1 = froude * std::sqrt(g * h1);
      const double eta = exact::normal_shock_depth_ratio(froude), speed = u1 / (eta - 1), t = 1.2 / speed;
      const double wall = obstacle ? 1.9 : 2.0;
      const std::string name =
          std::string("shock at a ") + (obstacle ? "step" : "side") + ", Fr " + std::to_string(static_cast<int>(froude));
      Study depth("f", name, "h [m], L1"), ratio("f", name, "depth behind the shock, relative error");
      Study place("f", name, "place of the shock [cells], error"), push("f", name, "force on the wall, relative error");
      for (int n : {100, 200, 400}) {
        SolverSettings settings = row<TypeParam>(n, 0, 2, Side::Kind::wall);
        settings.sides[0] = {Side::Kind::inflow, h1, u1};
        settings.closure.tan_delta = std::tan(zeta);
        StepBed bed;
        if (obstacle) bed.obstacles.push_back({"wall", wall, 9, -9, 9, 100});
        auto s = TypeParam::make(settings, ReferenceSurface::incline(zeta, 2), bed);
        s.set([&](double x, double) { return x < wall ? FlowState{h1, h1 * u1, 0} : FlowState{}; });
        const auto impulse = [&] {
          if (obstacle) return s.obstacle_impulse(0)[0];
          const double entered = (h1 * u1 * u1 + 0.5 * g * h1 * h1) * s.time() * s.grid().dy;
          return entered - s.budget().boundary[0];
        };
        s.advance_to(0.5 * t);
        const double before = impulse();
        s.advance_to(t);

        const auto exact = [&](double x) {  // the mean of the cell
          const double share = std::clamp((x - (wall - 1.2)) / s.grid().dx + 0.5, 0.0, 1.0);
          return exact::DepthVelocity{x < wall ? h1 * (1 + share * (eta - 1)) : 0.0, share == 1 ? 0 : u1};
        };
        depth.add(n, row_error(s, exact).h);
        const auto behind = [&](double x) { return x > wall - 0.9 && x < wall - 0.1; };
        double mean = 0, cells = 0;
        for (int i = 0; i < n; ++i) {
          if (behind(s.grid().x(i))) mean += s.at(i, 0).h, ++cells;
        }
        ratio.add(n, std::abs(mean / cells / h1 / eta - 1));
        const int last = static_cast<int>(std::lround(wall / s.grid().dx)) - 1;
        place.add(n, std::abs(crossing(s, 0.5 * (1 + eta) * h1, last, 0) - (wall - 1.2)) / s.grid().dx);
        const double force = (impulse() - before) / (0.5 * t) / s.grid().dy;
        push.add(n, std::abs(force / (0.5 * g * h1 * h1 * eta * eta) - 1));
        if (n == 200 && froude == 7 && !obstacle) {
          std::vector<std::vector<double>> rows;
          for (int i = 0; i < n; ++i) rows.push_back({s.grid().x(i), s.at(i, 0).h, exact(s.grid().x(i)).h});
          record_profile("wall_shock", "x,h,exact", rows);
        }
      }
      depth.expect_order(TypeParam::order_shock);
      ratio.expect_below(1e-3);
      place.expect_below(1);
      push.expect_below(0.01);
    }
  }
}

}  // namespace
}  // namespace couloir::test
