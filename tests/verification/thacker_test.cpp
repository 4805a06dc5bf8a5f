#include "continuum/exact/thacker.hpp"

#include <algorithm>

#include "continuum/exact/depth_velocity.hpp"
#include "errors.hpp"
#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

template <class S>
class Thacker : public SchemeTest<S> {
 public:
  static constexpr exact::ThackerBasin basin{0.1, 1.0, 0.5, 9.81};
  static double period() { return 2 * pi / basin.omega(); }

  static auto start(int n, bool along_x, Limiter limiter) {
    SolverSettings s = row<S>(n, -2, 4, Side::Kind::outflow);
    s.limiter = limiter;
    if (!along_x) {
      s.grid = {1, n, 4.0 / n, 4.0 / n, 0, -2};
      s.sides = sides(Side::Kind::wall, Side::Kind::outflow);
    }
    auto solver = S::make(s, ReferenceSurface::flat(4), [=](double x, double y) { return basin.bed(along_x ? x : y); });
    solver.set([&](double x, double y) { return FlowState{basin.depth(along_x ? x : y, 0), 0, 0}; });
    return solver;
  }
};
TYPED_TEST_SUITE(Thacker, Schemes, SchemeNames);

// references.md 2e: one and a quarter periods of the plane motion, shores wetting and drying.
TYPED_TEST(Thacker, SwingsInTheBasin) {
  using T = Thacker<TypeParam>;
  const double t = 1.25 * T::period();
  Study whole("e", "Thacker's basin", "h [m], L1"), momentum("e", "Thacker's basin", "hu [m2/s], L1");
  for (int n : {100, 200, 400, 800}) {
    auto s = T::start(n, true, TypeParam::smooth);
    const double volume = s.volume();
    s.advance_to(t);
    EXPECT_NEAR(s.volume(), volume, 1e-13);
    EXPECT_GE(s.min_depth(), 0);
    const auto exact = [&](double x) { return exact::DepthVelocity{T::basin.depth(x, t), T::basin.velocity(t)}; };
    const auto e = row_error(s, exact);
    whole.add(n, e.h);
    momentum.add(n, e.hu);
  }
  whole.expect_order(TypeParam::order_shock);
  momentum.expect_order(TypeParam::order_shock);
}

// The picture: half of the way back.
TYPED_TEST(Thacker, Profile) {
  using T = Thacker<TypeParam>;
  const double t = 1.1 * T::period();
  auto s = T::start(200, true, TypeParam::smooth);
  s.advance_to(t);
  std::vector<std::vector<double>> rows;
  double most = 0;
  for (int i = 0; i < 200; ++i) {
    const double x = s.grid().x(i), exact = T::basin.depth(x, t);
    rows.push_back({x, T::basin.bed(x), s.at(i, 0).h, exact});
    most = std::max(most, std::abs(s.at(i, 0).h - exact));
  }
  record_profile(std::string("thacker_") + TypeParam::name, "x,bed,h,exact", rows);
  EXPECT_LT(most, 0.01 * T::basin.h0);
}

// With minmod short waves grow where the flow passes its waves' speed on the sloping bed, docs/decisions/0007. They stay small.
TYPED_TEST(Thacker, PlainLimiterStaysNear) {
  using T = Thacker<TypeParam>;
  const double t = 1.25 * T::period(), volume = 4.0 / 3 * T::basin.h0 * T::basin.a;
  Study study("e", "Thacker's basin, default limiter", "h [m], L1");
  for (int n : {200, 400, 800}) {
    auto s = T::start(n, true, TypeParam::plain);
    s.advance_to(t);
    study.add(n, row_error(s, [&](double x) { return exact::DepthVelocity{T::basin.depth(x, t), T::basin.velocity(t)}; }).h);
  }
  study.expect_below(0.005 * volume / 4);
}

// Along y as along x, to the bit.
TYPED_TEST(Thacker, SwingsAlikeInBothDirections) {
  using T = Thacker<TypeParam>;
  auto x = T::start(100, true, TypeParam::smooth), y = T::start(100, false, TypeParam::smooth);
  x.advance_to(T::period());
  y.advance_to(T::period());
  for (int k = 0; k < 100; ++k) EXPECT_EQ(x.at(k, 0).h, y.at(0, k).h);
}

}  // namespace
}  // namespace couloir::test
