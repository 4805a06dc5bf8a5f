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

// A uniform flow runs against a wall, the domain's side or a step obstacle: on a level bed without friction, or on a slope with
// delta = zeta, where the material behind the shock is at rest and held. The force is the mean while the shock runs from 0.6
// to 1.2 m; the error of depth the mean, that of its place the worst, while it crosses one more cell.
TYPED_TEST(WallShock, DepthPlaceAndForce) {
  struct Kind {
    const char* name;
    bool obstacle, held;
  };
  for (const Kind& kind : {Kind{"side, no friction", false, false}, Kind{"side", false, true}, Kind{"step", true, true}}) {
    const bool obstacle = kind.obstacle;
    if (obstacle && !TypeParam::has_steps) continue;
    for (double froude : {1.0, 2.0, 3.0, 5.0, 7.0}) {
      const double zeta = kind.held ? degrees(30) : 0, g = 9.81 * std::cos(zeta), h1 = 0.05, u1 = froude * std::sqrt(g * h1);
      const double eta = exact::normal_shock_depth_ratio(froude), speed = u1 / (eta - 1), t = 1.2 / speed;
      const double wall = obstacle ? 1.9 : 2.0;
      const std::string name = std::string("shock at a ") + kind.name + ", Fr " + std::to_string(static_cast<int>(froude));
      Study depth("f", name, "h [m], L1"), ratio("f", name, "depth behind the shock, relative error");
      Study place("f", name, "place of the shock [cells], error"), push("f", name, "force on the wall, relative error");
      for (int n : {100, 200, 400}) {
        SolverSettings settings = row<TypeParam>(n, 0, 2, Side::Kind::wall);
        settings.sides[0] = {Side::Kind::inflow, h1, u1};
        settings.closure.tan_delta = std::tan(zeta);
        auto s = [&] {
          const auto surface = ReferenceSurface::incline(zeta, 2);
          if constexpr (TypeParam::has_steps) {
            if (obstacle) return TypeParam::make(settings, surface, {}, {{"wall", wall, 9, -9, 9, 100}});
          }
          return TypeParam::make(settings, surface);
        }();
        s.set([&](double x, double) { return x < wall ? FlowState{h1, h1 * u1, 0} : FlowState{}; });
        const auto impulse = [&] {
          if (obstacle) return s.obstacle_impulse(0)[0];
          return -s.budget().sides[1][0];
        };
        s.advance_to(0.5 * t);
        const double before = impulse();
        s.advance_to(t);

        const double force = (impulse() - before) / (0.5 * t) / s.grid().dy;
        push.add(n, std::abs(force / (0.5 * g * h1 * h1 * eta * eta) - 1));
        const auto behind = [&](double x) { return x > wall - 0.9 && x < wall - 0.1; };
        double mean = 0, cells = 0;
        for (int i = 0; i < n; ++i) {
          if (behind(s.grid().x(i))) mean += s.at(i, 0).h, ++cells;
        }
        ratio.add(n, std::abs(mean / cells / h1 / eta - 1));
        const int last = static_cast<int>(std::lround(wall / s.grid().dx)) - 1;
        double miss = 0, off = 0;
        constexpr int times = 8;
        for (int k = 0; k < times; ++k) {
          const double front = wall - 1.2 - k * s.grid().dx / times;
          s.advance_to((wall - front) / speed);
          const auto exact = [&](double x) {  // the mean of the cell
            const double share = std::clamp((x - front) / s.grid().dx + 0.5, 0.0, 1.0);
            return exact::DepthVelocity{x < wall ? h1 * (1 + share * (eta - 1)) : 0.0, share == 1 ? 0 : u1};
          };
          miss += row_error(s, exact).h / times;
          off = std::max(off, std::abs(crossing(s, 0.5 * (1 + eta) * h1, last, 0) - front) / s.grid().dx);
          if (k == 0 && n == 200 && froude == 7 && kind.held && !obstacle) {
            std::vector<std::vector<double>> rows;
            for (int i = 0; i < n; ++i) rows.push_back({s.grid().x(i), s.at(i, 0).h, exact(s.grid().x(i)).h});
            record_profile(std::string("wall_shock_") + TypeParam::name, "x,h,exact", rows);
          }
        }
        depth.add(n, miss);
        place.add(n, off);
      }
      depth.expect_order(kind.held ? TypeParam::order_held_shock : TypeParam::order_shock);
      ratio.expect_below(1e-3);
      place.expect_below(1);
      push.expect_below(0.01);
    }
  }
}

}  // namespace
}  // namespace couloir::test
