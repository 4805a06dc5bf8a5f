#include "continuum/exact/oblique_shock.hpp"

#include <algorithm>

#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

TEST(ObliqueShockTable, ExactAngles) {  // references.md 2g
  const auto shock = exact::oblique_shock(5, degrees(20));
  EXPECT_NEAR(shock.beta / degrees(1), 30.692, 5e-4);
  EXPECT_NEAR(shock.eta, 3.1437, 5e-5);
  EXPECT_NEAR(shock.froude_behind, 2.468, 5e-4);
  EXPECT_NEAR(shock.eta, std::tan(shock.beta) / std::tan(shock.beta - degrees(20)), 1e-10);
  EXPECT_NEAR(exact::oblique_limit(5).theta / degrees(1), 45.975, 5e-4);
  EXPECT_TRUE(std::isnan(exact::oblique_shock(5, degrees(46)).beta));
}

template <class S>
class ObliqueShock : public SchemeTest<S> {
 public:
  static constexpr double froude = 5, depth = 0.05, length = 1.2, height = 0.4;

  // A uniform flow whose direction makes the angle theta with the straight wall y = 0, or, mirrored, two such flows that meet
  // head-on there: the same shock on either side. What flows in through the upstream and the outer sides is held by setting
  // two cells there before each step; the wall begins behind them, at x = 0.
  static auto run(int nx, double theta, bool mirrored) {
    SolverSettings s;
    const double dx = length / nx, speed = froude * std::sqrt(9.81 * depth);
    const int half = static_cast<int>(std::lround(height / dx)), ny = mirrored ? 2 * half : half, held = 2;
    s.grid = {nx + held, ny, dx, dx, -held * dx, mirrored ? -half * dx : 0};
    s.sides = sides(Side::Kind::outflow, Side::Kind::outflow);
    s.sides[2].kind = mirrored ? Side::Kind::outflow : Side::Kind::wall;
    s.limiter = S::plain;
    auto solver = S::make(s, ReferenceSurface::flat(length));
    const auto inflow = [&](double y) {
      return FlowState{depth, depth * speed * std::cos(theta), (y > 0 ? -1 : 1) * depth * speed * std::sin(theta)};
    };
    solver.set([&](double, double y) { return inflow(y); });
    while (solver.time() < 3 * length / speed) {
      for (int j = 0; j < ny; ++j) {
        const bool outer = j >= ny - held || (mirrored && j < held);
        for (int i = 0; i < (outer ? s.grid.nx : held); ++i) solver.set(i, j, inflow(s.grid.y(j)));
      }
      solver.step(solver.stable_dt());
    }
    return solver;
  }

  struct Front {
    double angle, worst;  // to the incoming flow [rad]; greatest distance from the exact line [cells]
  };
  // A straight line through where the depth crosses the mean of both sides, clear of the corner and of the outlet.
  template <class Solver>
  static Front front(const Solver& s, double theta, const exact::ObliqueShock& shock) {
    const double level = 0.5 * (1 + shock.eta) * depth, dx = s.grid().dx;
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, worst = 0;
    for (int i = 0; i < s.grid().nx; ++i) {
      const double x = s.grid().x(i);
      if (x < 0.2 * length || x > 0.95 * length) continue;
      for (int j = s.grid().ny - 1; j > 0; --j) {
        const double outer = s.at(i, j).h, inner = s.at(i, j - 1).h;
        if (outer >= level || inner < level) continue;
        const double y = s.grid().y(j) - dx * (level - outer) / (inner - outer);
        ++n, sx += x, sy += y, sxx += x * x, sxy += x * y;
        const double off = shock.beta - theta;
        worst = std::max(worst, std::abs(y * std::cos(off) - x * std::sin(off)) / dx);
        break;
      }
    }
    return {theta + std::atan((n * sxy - sx * sy) / (n * sxx - sx * sx)), worst};
  }
};
TYPED_TEST_SUITE(ObliqueShock, Schemes, SchemeNames);

TYPED_TEST(ObliqueShock, StandsAtTheExactAngle) {
  using T = ObliqueShock<TypeParam>;
  const double theta = degrees(20);
  const auto shock = exact::oblique_shock(T::froude, theta);
  const std::string name = "oblique shock, F 5, theta 20";
  Study l1("g", name, "h [m], L1"), angle("g", name, "angle 30.692 deg, error [deg]"),
      place("g", name, "place of the shock [cells], error");
  for (int n : {60, 120, 240}) {
    const auto s = T::run(n, theta, false);
    double sum = 0, cells = 0;
    std::vector<std::vector<double>> rows;
    for (int j = 0; j < s.grid().ny; ++j) {
      for (int i = 2; i < s.grid().nx; ++i) {
        const double x = s.grid().x(i), y = s.grid().y(j), line = x * std::tan(shock.beta - theta);
        const double share = std::clamp((line - y) / s.grid().dx + 0.5, 0.0, 1.0);  // of the cell behind the shock
        sum += std::abs(s.at(i, j).h - T::depth * (1 + share * (shock.eta - 1)));
        ++cells;
        rows.push_back({x, y, s.at(i, j).h});
      }
    }
    l1.add(n, sum / cells);
    const auto found = T::front(s, theta, shock);
    angle.add(n, std::abs(found.angle - shock.beta) / degrees(1));
    place.add(n, found.worst);
    if (n == 120) record_profile(std::string("oblique_shock_") + TypeParam::name, "x,y,h", rows);
  }
  l1.expect_order(TypeParam::order_shock);
  angle.expect_below(TypeParam::oblique_angle);
  place.expect_below(1);
}

// Two flows that meet head-on make the wall's shock on either side, mirrored to the bit.
TYPED_TEST(ObliqueShock, HeadOnFlowsMakeItOnBothSides) {
  using T = ObliqueShock<TypeParam>;
  const double theta = degrees(20);
  const auto both = T::run(60, theta, true), one = T::run(60, theta, false);
  const int ny = both.grid().ny;
  double most = 0;
  for (int j = 0; j < ny / 2; ++j) {
    for (int i = 0; i < both.grid().nx; ++i) {
      EXPECT_EQ(both.at(i, j).h, both.at(i, ny - 1 - j).h);
      EXPECT_EQ(both.at(i, j).hv, -both.at(i, ny - 1 - j).hv);
      most = std::max(most, std::abs(both.at(i, ny / 2 + j).h / one.at(i, j).h - 1));
    }
  }
  Study study("g", "oblique shock head-on, both sides", "depth against the wall's, greatest relative difference");
  study.add(60, most);
  study.expect_below(1e-10);
}

}  // namespace
}  // namespace couloir::test
