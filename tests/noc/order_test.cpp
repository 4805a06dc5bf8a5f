#include <gtest/gtest.h>

#include "continuum/exact/parabolic_cap.hpp"
#include "continuum/exact/sliding_slab.hpp"
#include "noc_scenes.hpp"
#include "tests/verification/errors.hpp"

namespace couloir::test {
namespace {

// A smooth hump that runs through a periodic channel over a level or a wavy bed, along x or along y.
std::vector<double> hump(int n, Limiter limiter, bool relief, bool along_x = true) {
  SolverSettings s = row(n, 0, 1, Side::Kind::periodic);
  s.sides = sides(Side::Kind::periodic, Side::Kind::periodic);
  if (!along_x) s.grid = {1, n, 1.0 / n, 1.0 / n, 0, 0};
  s.limiter = limiter;
  NocBed bed;
  if (relief) bed.ground = [=](double x, double y) { return 0.02 * std::cos(2 * pi * (along_x ? x : y)); };
  NocSolver solver(s, ReferenceSurface::flat(1), bed);
  solver.set([&](double x, double y) {
    const double h = 0.2 + 0.02 * std::sin(2 * pi * (along_x ? x : y));
    return along_x ? FlowState{h, 0.3 * h, 0} : FlowState{h, 0, 0.3 * h};
  });
  solver.advance_to(0.15);
  std::vector<double> h;
  for (int k = 0; k < n; ++k) h.push_back(along_x ? solver.at(k, 0).h : solver.at(0, k).h);
  return h;
}

const char* name(Limiter l) {
  const char* names[] = {"minmod", "van_leer", "mc", "superbee", "eno"};
  return names[static_cast<int>(l)];
}

TEST(NocOrder, SmoothHump) {
  for (bool relief : {false, true}) {
    const auto reference = hump(3200, Limiter::eno, relief);
    for (Limiter limiter : {Limiter::minmod, Limiter::van_leer, Limiter::mc, Limiter::superbee, Limiter::eno}) {
      const double e100 = error_to_finer(hump(100, limiter, relief), reference),
                   e200 = error_to_finer(hump(200, limiter, relief), reference);
      const double e400 = error_to_finer(hump(400, limiter, relief), reference);
      std::printf("noc smooth, %s, relief %d: L1 %.3e %.3e %.3e, orders %.2f %.2f\n", name(limiter), relief, e100, e200, e400,
                  order(e100, e200), order(e200, e400));
      EXPECT_GT(order(e100, e400, 4), 1.8) << name(limiter);
    }
  }
}

TEST(NocOrder, AcrossTheSlopeAsAlongIt) {
  EXPECT_EQ(hump(100, Limiter::minmod, true, false), hump(100, Limiter::minmod, true, true));
}

// Smooth in both directions, with everything that acts: slope, friction, earth pressure of the hydraulic kind, a wavy bed.
TEST(NocOrder, SmoothInTwoDimensionsWithFriction) {
  const auto run = [](int n) {
    SolverSettings s;
    s.grid = {n, n, 1.0 / n, 1.0 / n, 0, 0};
    s.sides = sides(Side::Kind::periodic, Side::Kind::periodic);
    s.closure = {EarthPressure::hydraulic(), std::tan(degrees(20)), true};
    s.limiter = Limiter::eno;
    NocBed bed;
    bed.ground = [](double x, double y) { return 0.01 * std::sin(2 * pi * x) * std::cos(2 * pi * y); };
    NocSolver solver(s, ReferenceSurface::incline(degrees(25), 1), bed);
    solver.set([](double x, double y) {
      const double h = 0.2 + 0.02 * std::sin(2 * pi * x) * std::cos(2 * pi * y);
      return FlowState{h, 1.0 * h, 0.4 * h};
    });
    solver.advance_to(0.1);
    return solver;
  };
  const NocSolver fine = run(256);
  const auto error = [&](int n) {
    const NocSolver coarse = run(n);
    const int ratio = 256 / n;
    double sum = 0;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        double mean = 0;
        for (int b = 0; b < ratio; ++b) {
          for (int a = 0; a < ratio; ++a) mean += fine.at(i * ratio + a, j * ratio + b).hu;
        }
        sum += std::abs(coarse.at(i, j).hu - mean / (ratio * ratio)) / (n * n);
      }
    }
    return sum;
  };
  const double e32 = error(32), e64 = error(64);
  std::printf("noc smooth 2D: L1 %.3e %.3e, order %.2f\n", e32, e64, order(e32, e64));
  EXPECT_GT(order(e32, e64), 1.8);
}

TEST(NocSlab, SlidesToRoundOffAndStops) {
  for (double delta : {0.0, 20.0, 40.0}) {
    SolverSettings s = row(20, 0, 2, Side::Kind::periodic);
    const double mu = std::tan(degrees(delta));
    s.closure = {EarthPressure::active_passive(degrees(40), degrees(28)), mu, true};
    NocSolver solver(s, ReferenceSurface::incline(degrees(30), 2), {});
    solver.set([&](double, double) { return FlowState{0.1, 0.2, 0}; });
    solver.advance_to(0.5);
    EXPECT_NEAR(solver.at(7, 0).hu, 0.1 * exact::sliding_slab_velocity(0.5, 2, 9.81, degrees(30), mu), 1e-13) << delta;
    EXPECT_NEAR(solver.at(7, 0).h, 0.1, 1e-14);
    if (delta < 30) continue;
    solver.advance_to(3);
    EXPECT_EQ(solver.max_speed(), 0);
  }
}

// Spreads while it slides: 35 deg, delta 25 deg (references 2b). With the literal switch between active and passive (2.85) the
// error does not fall: a known fault of that switch, which is not this scheme's to cure.
TEST(NocCap, SpreadsAsSavageAndHutter) {
  const double zeta = degrees(35), mu = std::tan(degrees(25)), weight = 9.81 * std::cos(zeta);
  const auto run = [&](int n, bool hydraulic) {
    SolverSettings s = row(n, 0, 3, Side::Kind::outflow);
    s.closure = {hydraulic ? EarthPressure::hydraulic() : EarthPressure::active_passive(degrees(40), degrees(25)), mu, true};
    const exact::ParabolicCap cap{0.4, 0.05, s.closure.earth_pressure.x_active * weight};
    NocSolver solver(s, ReferenceSurface::incline(zeta, 3), {});
    solver.set([&](double x, double) { return FlowState{cap.depth(x - 0.6, 1), 0, 0}; });
    const double t = 0.8, centre = 0.6 + 0.5 * weight * (std::tan(zeta) - mu) * t * t, g = cap.growth(t);
    solver.advance_to(t);
    return depth_error(solver, [&](double x) { return cap.depth(x - centre, g); });
  };
  const double volume = 0.4 * 0.05 * 4 / 3;
  for (bool hydraulic : {true, false}) {
    const double e150 = run(150, hydraulic), e300 = run(300, hydraulic), e600 = run(600, hydraulic);
    std::printf("noc cap, hydraulic %d: L1 %.3e %.3e %.3e, orders %.2f %.2f\n", hydraulic, e150, e300, e600, order(e150, e300),
                order(e300, e600));
    if (hydraulic) {
      EXPECT_GT(order(e150, e600, 4), 1.2);
      EXPECT_LT(e600, 0.002 * volume);
    } else {
      EXPECT_LT(e600, volume);
    }
  }
}

}  // namespace
}  // namespace couloir::test
