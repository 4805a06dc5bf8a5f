#include "continuum/exact/simple_wave.hpp"

#include "errors.hpp"
#include "schemes.hpp"
#include "study.hpp"

namespace couloir::test {
namespace {

template <class S>
class SimpleWave : public SchemeTest<S> {};
TYPED_TEST_SUITE(SimpleWave, Schemes, SchemeNames);

// Smooth throughout: a wave steepens to half of its way to breaking, on a flat bed and while it slides down with friction.
TYPED_TEST(SimpleWave, IsOfSecondOrder) {
  for (bool slope : {false, true}) {
    for (Limiter limiter : TypeParam::limiters) {
      const double zeta = slope ? degrees(32) : 0, mu = slope ? std::tan(degrees(25)) : 0, weight = 9.81 * std::cos(zeta);
      const exact::SimpleWave wave{0.1, 0.4, 0.05, 2 * pi, weight, weight * (std::tan(zeta) - mu)};
      const double t = 0.5 * wave.breaks();
      const std::string name =
          std::string("simple wave, ") + (slope ? "incline with friction, " : "flat, ") + limiter_name(limiter);
      Study depth("smooth", name, "h [m], L1"), momentum("smooth", name, "hu [m2/s], L1");
      for (int n : {100, 200, 400, 800}) {
        SolverSettings settings = row<TypeParam>(n, 0, 1, Side::Kind::periodic);
        settings.limiter = limiter;
        settings.closure.tan_delta = mu;
        auto s = TypeParam::make(settings, ReferenceSurface::incline(zeta, 1));
        s.set([&](double x, double) {
          const auto q = wave.at(x, 0);
          return FlowState{q.h, q.h * q.u, 0};
        });
        s.advance_to(t);
        const auto e = row_error(s, [&](double x) { return wave.at(x, t); });
        depth.add(n, e.h);
        momentum.add(n, e.hu);
      }
      depth.expect_order(TypeParam::order_smooth);
      momentum.expect_order(TypeParam::order_smooth);
    }
  }
}

}  // namespace
}  // namespace couloir::test
