#include "coupling/transfer/airborne.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "coupling/transfer/handback.hpp"

namespace couloir {
namespace {

using Edge = AirborneSettings::Edge;
constexpr double g = 9.81, rho = 1400, mass = 2e-4;

// Dry, 2 m x 0.4 m, cells of 20 mm; nothing in it is stepped.
struct Bench {
  ReferenceSurface surface;
  AirborneSettings settings;
  Solver solver;
  Airborne air;
  explicit Bench(ReferenceSurface s, std::array<Edge, 4> sides = {Edge::wall, Edge::open, Edge::wall, Edge::wall}, int nx = 100,
                 const StepBed& bed = {})
      : surface(s),
        settings(make(sides, nx, bed)),
        solver(solver_settings(settings.grid), surface, bed),
        air(settings, surface) {}
  static AirborneSettings make(std::array<Edge, 4> sides, int nx, const StepBed& bed) {
    AirborneSettings a;
    a.grid = {nx, 20, 0.02, 0.02, 0, -0.2};
    a.sides = sides;
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < nx; ++i) {
        double z = 0;
        for (const StepObstacle& o : bed.obstacles) z = std::max(z, o.top(a.grid.x(i), a.grid.y(j)));
        a.bed.push_back(z);
      }
    a.gravity = g;
    a.bulk_density = rho;
    return a;
  }
  static SolverSettings solver_settings(const Grid& grid) {
    SolverSettings s;
    s.grid = grid;
    s.closure = {EarthPressure::hydraulic(), 0.4, false};
    return s;
  }
  void throw_up(const SurfacePoint& from, double u, double v, double w, double m = mass) {
    const Eigen::Vector3d p = surface.to_space(from), speed = u * surface.tangent(from.x) + w * surface.normal(from.x);
    air.take_off(m, {p.x(), p.y(), p.z()}, {speed.x(), v, speed.z()});
  }
  std::vector<Airborne::Landing> until_down(double window = 1e-3) {
    std::vector<Airborne::Landing> all;
    for (int n = 0; n < 20000 && air.flights() > 0; ++n) {
      air.advance(window, solver);
      all.insert(all.end(), air.landings().begin(), air.landings().end());
    }
    return all;
  }
  double flow_mass() const { return rho * solver.volume(); }
  double flow_momentum() const { return rho * solver.momentum()[0]; }
};

// Time from height n0 to n1 on a plane inclined by zeta, thrown up at w.
double time_down(double n0, double n1, double w, double zeta) {
  const double gn = g * std::cos(zeta);
  return (w + std::sqrt(w * w + 2 * gn * (n0 - n1))) / gn;
}

TEST(Airborne, OnAnInclineItComesDownWhereBallisticsSays) {
  const double zeta = 0.6, n0 = 0.03, u0 = 1.3, v0 = 0.2, w0 = 1.1;
  for (const double depth : {0.0, 0.012}) {
    for (const double window : {1e-3, 0.0137}) {
      Bench b(ReferenceSurface::incline(zeta, 2));
      b.solver.set([&](double, double) { return FlowState{depth, 0, 0}; });
      const double flow = b.flow_mass();
      b.throw_up({0.4, -0.05, n0}, u0, v0, w0);
      EXPECT_DOUBLE_EQ(b.air.momentum(), mass * u0);
      const auto landings = b.until_down(window);
      ASSERT_EQ(landings.size(), 1u);
      const double t = time_down(n0, depth, w0, zeta), x = 0.4 + u0 * t + 0.5 * g * std::sin(zeta) * t * t;
      const Airborne::Landing& l = landings[0];
      EXPECT_NEAR(l.at.x, x, 1e-13);
      EXPECT_NEAR(l.at.y, -0.05 + v0 * t, 1e-13);
      EXPECT_NEAR(l.at.n, depth, 1e-13);
      EXPECT_EQ(l.i, int(x / 0.02));
      const double u = u0 + g * std::sin(zeta) * t;
      EXPECT_NEAR(l.along, u, 1e-13);
      const FlowState q = b.solver.at(l.i, l.j);
      const double h = mass / (rho * 0.02 * 0.02);
      EXPECT_NEAR(q.h, depth + h, 1e-16);
      EXPECT_NEAR(q.hu, h * u, 1e-15);
      EXPECT_NEAR(q.hv, h * v0, 1e-15);
      EXPECT_NEAR(b.air.collect().gravity, mass * g * std::sin(zeta) * t, 1e-16) << "m g sin(zeta) t";
      EXPECT_NEAR(b.flow_mass() - flow, mass, 1e-14);
      EXPECT_EQ(b.air.mass(), 0);
    }
  }
}

// From the slope over the arc onto the level run-out: a parabola in the level frame.
TEST(Airborne, FliesOverTheArcOntoTheRunout) {
  const double zeta = 0.7;
  Bench b(ReferenceSurface::chute(zeta, 0.5, 0.3, 1.2));
  b.throw_up({0.4, 0, 0.05}, 1.5, 0, 2.2);
  const Eigen::Vector3d p0 = b.surface.to_level(b.surface.to_space({0.4, 0, 0.05}));
  const Eigen::Vector3d v0 = b.surface.to_level(1.5 * b.surface.tangent(0.4) + 2.2 * b.surface.normal(0.4));
  const Eigen::Vector3d end = b.surface.to_level(b.surface.to_space({0.8, 0, 0}));
  const double t = (v0.z() + std::sqrt(v0.z() * v0.z() + 2 * g * (p0.z() - end.z()))) / g;
  const double x = 0.8 + p0.x() + v0.x() * t - end.x();
  ASSERT_GT(x, 0.9) << "on the run-out";
  const auto landings = b.until_down();
  ASSERT_EQ(landings.size(), 1u);
  EXPECT_NEAR(landings[0].at.x, x, 1e-12);
  EXPECT_NEAR(landings[0].along, v0.x(), 1e-13) << "level flight keeps its speed";
  EXPECT_NEAR(b.air.collect().gravity, mass * (landings[0].along - 1.5), 1e-16);
}

TEST(Airborne, LeavesTheDomainAtAnOpenEnd) {
  Bench b(ReferenceSurface::incline(0.6, 2));
  b.throw_up({1.9, 0, 0.02}, 2, 0, 1);
  b.throw_up({1.5, 0, 0.02}, 0.1, 0, 0.1);  // comes down before
  const double momentum = b.air.momentum();
  EXPECT_EQ(b.until_down().size(), 1u);
  EXPECT_DOUBLE_EQ(b.air.left(), mass);
  EXPECT_NEAR(b.flow_mass(), mass, 1e-18);
  const Airborne::Booked booked = b.air.collect();
  const double u_out = std::sqrt(4 + 2 * g * std::sin(0.6) * 0.1);  // from energy along the slope
  EXPECT_NEAR(booked.left, mass * u_out, 1e-15);
  EXPECT_NEAR(b.flow_momentum() + booked.left, momentum + booked.gravity, 1e-16);
}

TEST(Airborne, AWallStopsItInTheCellBesideIt) {
  Bench b(ReferenceSurface::incline(0.6, 2), {Edge::wall, Edge::wall, Edge::wall, Edge::wall});
  b.throw_up({1.9, 0.01, 0.02}, 2, 0, 1);
  b.throw_up({0.5, 0.17, 0.02}, 0, 2, 1);
  b.throw_up({0.1, -0.01, 0.02}, -3, 0, 1);
  const double momentum = b.air.momentum();
  const auto landings = b.until_down();
  ASSERT_EQ(landings.size(), 3u);
  std::vector<std::array<int, 2>> cells;
  for (const auto& l : landings) cells.push_back({l.i, l.j});
  EXPECT_EQ(cells[0], (std::array{25, 19}));
  EXPECT_EQ(std::count(cells.begin(), cells.end(), std::array{99, 10}), 1);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), std::array{0, 9}), 1);
  EXPECT_NEAR(b.flow_mass(), 3 * mass, 1e-18);
  EXPECT_NEAR(b.flow_momentum(), momentum + b.air.collect().gravity, 1e-16) << "the walls take it from the flow";
}

TEST(Airborne, GoesOnRoundPeriodicSides) {
  const double zeta = 0.5, t = time_down(0.01, 0, 2, zeta);
  Bench b(ReferenceSurface::incline(zeta, 2), {Edge::periodic, Edge::periodic, Edge::periodic, Edge::periodic});
  b.throw_up({1.9, 0.15, 0.01}, 1, 1.1, 2);
  const auto landings = b.until_down();
  ASSERT_EQ(landings.size(), 1u);
  EXPECT_NEAR(landings[0].at.x, 1.9 + t + 0.5 * g * std::sin(zeta) * t * t - 2, 1e-12);
  EXPECT_NEAR(landings[0].at.y, 0.15 + 1.1 * t - 2 * 0.4, 1e-12);
  EXPECT_NEAR(b.air.collect().gravity, mass * g * std::sin(zeta) * t, 1e-16);
}

TEST(Airborne, AStepStopsItOrCarriesIt) {
  StepBed bed;
  bed.obstacles.push_back({"wall", 1.0, 1.1, -0.1, 0.1, 0.08});
  const auto down = [&](double w) {
    Bench b(ReferenceSurface::flat(2), {Edge::wall, Edge::open, Edge::wall, Edge::wall}, 100, bed);
    b.throw_up({0.8, 0.01, 0.01}, 1, 0, w);
    return b.until_down().at(0);
  };
  EXPECT_EQ(down(1.05).i, 49) << "too low: it comes down at the foot";
  EXPECT_NEAR(down(1.05).at.x, 1.0, 1e-12);
  const double t = time_down(0.01, 0.08, 1.6, 0), x = 0.8 + t;
  EXPECT_NEAR(down(1.6).at.x, x, 1e-12) << "on its top";
  EXPECT_NEAR(down(1.6).at.n, 0.08, 1e-12);
  EXPECT_GE(down(1.6).i, 50);
  EXPECT_NEAR(down(2.5).at.x, 0.8 + time_down(0.01, 0, 2.5, 0), 1e-12) << "beyond it";
}

TEST(Airborne, AZoneHasWhatFliesOverItComeDownAtItsRim) {
  Bench b(ReferenceSurface::flat(2));
  const int zone = b.solver.cover({50, 60, 5, 15});
  b.throw_up({0.8, 0, 0.05}, 2, 0, 2);
  b.throw_up({0.8, 0.15, 0.05}, 2, 0, 0.1);  // passes beside it
  const double momentum = b.air.momentum();
  const auto landings = b.until_down();
  ASSERT_EQ(landings.size(), 2u);
  for (const auto& l : landings) {
    EXPECT_TRUE(l.j != 10 || l.i == 49) << l.i;
  }
  EXPECT_NEAR(b.flow_mass(), 2 * mass, 1e-18);
  EXPECT_NEAR(b.flow_momentum(), momentum, 1e-16);

  b.throw_up({0.97, 0.001, 0.3}, 0.5, 0, 0);  // the zone grows under it
  b.solver.move_zone(zone, {46, 60, 5, 15});
  b.air.advance(1e-3, b.solver);
  ASSERT_EQ(b.air.landings().size(), 1u);
  EXPECT_EQ(b.air.landings()[0].i, 45);
  EXPECT_THROW(b.solver.add(50, 10, {0.01, 0, 0}), std::out_of_range);
}

// Many at once over all that there is: mass, and momentum along the slope, to round-off.
TEST(Airborne, KeepsMassAndMomentum) {
  StepBed bed;
  bed.obstacles.push_back({"block", 1.4, 1.5, -0.06, 0.06, 0.1});
  Bench b(ReferenceSurface::incline(0.55, 2), {Edge::wall, Edge::open, Edge::periodic, Edge::periodic}, 100, bed);
  b.solver.set([](double x, double y) { return FlowState{x > 0.7 ? 0.02 + 0.01 * std::sin(9 * x + 5 * y) : 0, 0, 0}; });
  b.solver.cover({40, 50, 5, 15});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> one(0, 1);
  double thrown = 0;
  for (int n = 0; n < 500; ++n) {
    const double m = 1e-5 * (1 + one(random));
    b.throw_up({0.3 + 0.4 * one(random), 0.39 * (one(random) - 0.5), 0.02 + 0.1 * one(random)}, 4 * one(random) - 1,
               2 * one(random) - 1, 3 * one(random), m);
    thrown += m;
  }
  const double mass0 = b.flow_mass() + b.air.mass();
  double momentum = b.flow_momentum() + b.air.momentum();
  EXPECT_NEAR(b.air.mass(), thrown, 1e-16);
  b.solver.reset_budget();
  for (int n = 0; n < 900; ++n) {
    b.air.advance(2e-3, b.solver);
    const Airborne::Booked booked = b.air.collect();
    momentum += booked.gravity - booked.left;
    ASSERT_NEAR(b.flow_mass() + b.air.mass() + b.air.left(), mass0, 1e-14 * mass0) << n;
    ASSERT_NEAR(b.flow_momentum() + b.air.momentum(), momentum + rho * b.solver.budget().cutoff[0], 1e-14) << n;
  }
  EXPECT_EQ(b.air.flights(), 0u);
  EXPECT_GT(b.air.left(), 0.02 * thrown);
  EXPECT_NEAR(rho * b.solver.budget().mass_added, thrown - b.air.left(), 1e-14 * mass0);
}

TEST(Airborne, CheckpointContinuesToTheSameBits) {
  const auto run = [](bool broken) {
    Bench b(ReferenceSurface::chute(0.6, 0.8, 0.2, 1));
    for (int n = 0; n < 7; ++n) b.throw_up({0.2 + 0.05 * n, 0.02 * n - 0.05, 0.03}, 1 + 0.1 * n, 0.1, 0.5 + 0.2 * n);
    for (int n = 0; n < 100; ++n) b.air.advance(1e-3, b.solver);
    if (broken) {
      Archive out;
      out(b.air);
      Airborne again(b.settings, b.surface);
      Archive in(0, out.bytes());
      in(again);
      EXPECT_TRUE(in.at_end());
      b.air = again;
    }
    b.until_down();
    Archive end;
    end(b.air);
    std::vector<double> h, hu, hv;
    b.solver.gather(h, hu, hv);
    return std::tuple(end.bytes(), h, hu, hv);
  };
  EXPECT_EQ(run(false), run(true));
}

struct InFlight : testing::Test {
  Bench b{ReferenceSurface::incline(0.4, 2)};
  static constexpr double d = 0.004;
  Grains grains(std::vector<Vec> at) {
    Grains all;
    for (const Vec& p : at) {
      all.id.push_back(std::int64_t(all.id.size()) + 1);
      all.x.push_back(p[0]), all.y.push_back(p[1]), all.z.push_back(p[2]);
      all.vx.push_back(1), all.vy.push_back(0), all.vz.push_back(1);
      all.radius.push_back(d / 2), all.driven.push_back(0);
    }
    return all;
  }
  bool flies(const Grains& all) { return b.air.take_off(all, 0, mass, d, b.solver); }
};

TEST_F(InFlight, IsWhatIsAloneAndHighAboveTheFlow) {
  EXPECT_FALSE(flies(grains({{0.5, 0, 1.4 * d}})));
  EXPECT_EQ(b.air.flights(), 0u);
  EXPECT_TRUE(flies(grains({{0.5, 0, 1.6 * d}})));
  EXPECT_DOUBLE_EQ(b.air.mass(), mass);
  EXPECT_FALSE(flies(grains({{0.5, 0, 3.0 * d}, {0.5, 0, 1.5 * d}}))) << "something lies below";
  EXPECT_TRUE(flies(grains({{0.5, 0, 3.0 * d}, {0.5, 0, 4.5 * d}}))) << "something lies above";
  EXPECT_TRUE(flies(grains({{0.5, 0, 4.0 * d}, {0.5, 0, 1.5 * d}}))) << "too far below";
  b.solver.set([](double, double) { return FlowState{3 * d, 0, 0}; });
  EXPECT_FALSE(flies(grains({{0.5, 0, 4.0 * d}})));
  EXPECT_TRUE(flies(grains({{0.5, 0, 4.6 * d}})));
  b.solver.cover({20, 30, 5, 15});
  EXPECT_FALSE(flies(grains({{0.5, 0, 8.0 * d}}))) << "over another zone";
  EXPECT_FALSE(flies(grains({{2.01, 0, 8.0 * d}}))) << "beyond the domain";
}

TEST_F(InFlight, IsNeitherHandedBackNorAShadow) {
  const Rim rim(b.settings.grid, {20, 40, 5, 15}, b.surface, RimSettings{.diameter = d, .anchor = {}});
  Handback handback(rim, b.surface, 2500);
  std::vector<std::vector<Handback::Outside>> outside;
  for (const RimFace& f : rim.faces()) outside.emplace_back(f.segments, Handback::Outside{false, rim.buffer()});
  const Grains all = grains({{0.801, 0, 10 * d}, {0.801, 0.03, 0.5 * d}, {0.5, 0.03, 10 * d}});
  std::vector<std::int64_t> remove;
  const auto fly = [&](std::size_t k) { return b.air.take_off(all, k, grain_mass(all.radius[k], 2500), d, b.solver); };
  for (int again : {0, 1}) {
    handback.sort(all, outside, remove, fly);
    EXPECT_EQ(handback.returned(), 2) << again;
    EXPECT_EQ(b.air.flights(), 1u) << again;
    EXPECT_DOUBLE_EQ(handback.pending_mass(), grain_mass(d / 2, 2500)) << "of the one on the bed";
  }
  EXPECT_EQ(remove, std::vector<std::int64_t>{1});
  EXPECT_TRUE(handback.is_shadow(1)) << "counted no more";
  EXPECT_FALSE(handback.is_shadow(3)) << "in the zone";
}

}  // namespace
}  // namespace couloir
