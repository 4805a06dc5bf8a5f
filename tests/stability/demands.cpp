#include "demands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "continuum/scheme/mobilisation.hpp"
#include "continuum/solver.hpp"

namespace couloir::test {

void Worst::take(const Worst& w) {
  mass = std::max(mass, w.mass);
  energy = std::max(energy, w.energy);
  speed = std::max(speed, w.speed);
  least = std::min(least, w.least);
  clipped = std::max(clipped, w.clipped);
  finite = finite && w.finite;
}

Demands::Demands(const Case& c, const Subject& subject, FlowModel& solver) : case_(c), subject_(subject), solver_(solver) {
  const Grid& g = c.grid();
  const EarthPressure& k = c.settings.closure.earth_pressure;
  k0_ = std::max(1.0, k.x_active);
  k_most_ = std::max(k.x_passive, k.y_passive_passive);
  has_energy_ = !c.has(Side::Kind::inflow) && k.x_passive <= stiffest;
  const ReferenceSurface surface = c.surface();
  height_.assign(g.nx, 0.0);
  for (int i = g.nx - 1; i >= 0; --i) {
    const double zeta = surface.angle(g.x(i));
    weight_.insert(weight_.begin(), c.settings.gravity * std::cos(zeta));
    const double kappa = surface.curvature(g.x(i));
    arc_.insert(arc_.begin(), c.settings.gravity * std::sin(zeta) * kappa);
    drive_ = std::max(drive_, c.settings.gravity * std::sin(zeta));
    if (i + 1 < g.nx) height_[i] = height_[i + 1] + 0.5 * g.dx * (std::sin(zeta) + std::sin(surface.angle(g.x(i + 1))));
  }
  bed_.assign(std::size_t(g.nx) * g.ny, 0.0);
  if (!c.bed.elevation.empty()) bed_ = c.bed.elevation;
  const auto raise = [&](const auto& height) {
    for (int j = 0; j < g.ny; ++j) {
      for (int i = 0; i < g.nx; ++i) bed_[std::size_t(j) * g.nx + i] += height(g.x(i), g.y(j));
    }
  };
  for (const StepObstacle& o : c.bed.obstacles) {
    if (!subject.has_steps) raise([body = body_of(o, g)](double x, double y) { return body.at(x, y); });
  }
  const double lowest = *std::ranges::min_element(bed_);
  for (double& z : bed_) z -= lowest;
  drop_ = *std::ranges::max_element(bed_);
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const std::size_t c = std::size_t(j) * g.nx + i;
      const double s = std::sin(surface.angle(g.x(i))) * g.dx, z = std::cos(surface.angle(g.x(i)));
      double d = s;
      if (i + 1 < g.nx) d = std::max(d, std::abs(s - z * (bed_[c + 1] - bed_[c])));
      if (j + 1 < g.ny) d = std::max(d, z * std::abs(bed_[c + g.nx] - bed_[c]));
      cell_drop_ = std::max(cell_drop_, d);
    }
  }
  if (subject.has_steps) {
    raise([&](double x, double y) {
      double top = 0;
      for (const StepObstacle& o : c.bed.obstacles) {
        if (o.covers(x, y)) top = std::max(top, o.height);
      }
      return top;
    });
  }
  if (c.settings.sides[0].kind == Side::Kind::periodic) seam_ = solver.add_gauge(0, 0, g.ny);
  volume0_ = solver.volume();
  u0_ = solver.max_speed();
  for (const Side& s : c.settings.sides) {
    if (s.kind != Side::Kind::inflow) continue;
    u0_ = std::max(u0_, s.velocity);
    deepest_ = std::max(deepest_, s.depth);
  }
  solver.gather(h_, hu_, hv_);
  e0_ = least_e_ = energy();
  look(0);
}

double Demands::energy() const {
  const int nx = case_.grid().nx;
  double sum = 0;
  for (std::size_t c = 0; c < h_.size(); ++c) {
    const int i = int(c % nx);
    if (!(h_[c] > 0)) continue;
    sum += 0.5 * (hu_[c] * hu_[c] + hv_[c] * hv_[c]) / h_[c] + weight_[i] * h_[c] * (0.5 * k0_ * h_[c] + bed_[c]) +
           case_.settings.gravity * h_[c] * height_[i] + stored(i, static_cast<int>(c) / nx);
  }
  return sum * case_.grid().dx * case_.grid().dy;
}

// What compression has stored in the earth pressure, per area: K follows the strain from K0 at the share x0 to K at x (decision
// 0004), so p passive_strain (K_passive - K_active) (x - x0)^2 / 2 along each axis.
double Demands::stored(int i, int j) const {
  const auto* flow = dynamic_cast<const Solver*>(&solver_);
  const EarthPressure& k = case_.settings.closure.earth_pressure;
  if (flow == nullptr || k.is_hydraulic()) return 0;
  const auto [kx, ky] = flow->earth_pressure(i, j);
  const auto spring = [&](double k, double active, double passive) {
    const double range = passive - active, x0 = std::clamp((k0_ - active) / range, 0.0, 1.0);
    return range > 0 ? 0.5 * range * std::pow((k - active) / range - x0, 2) : 0.0;
  };
  const double x = (kx - k.x_active) / (k.x_passive - k.x_active);
  const double along = spring(kx, k.x_active, k.x_passive);
  const double across = spring(ky, k.ky_mobilised(x, 0), k.ky_mobilised(x, 1));
  const double h = h_[std::size_t(j) * case_.grid().nx + i];
  return 0.5 * weight_[i] * h * h * passive_strain * (along + across);
}

// What may feed E, per area of a cell: the weight's change along an arc; and with noc, which takes slow flow as active, (K0 - K)
// p |du/dx| as long as K < K0.
double Demands::supply() const {
  const Grid& g = case_.grid();
  const bool remembers = dynamic_cast<const Solver*>(&solver_) != nullptr;
  const EarthPressure& k = case_.settings.closure.earth_pressure;
  const auto share = [&](double act, double pas) { return pas > act ? std::clamp((k0_ - act) / (pas - act), 0.0, 1.0) : 0.0; };
  const double sx = share(k.x_active, k.x_passive);
  const double sy = std::max(share(k.y_active_active, k.y_passive_active), share(k.y_active_passive, k.y_passive_passive));
  const double kx = k0_ - k.x_active, ky = k0_ - std::min(k.y_active_active, k.y_active_passive);
  double sum = 0;
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const std::size_t c = std::size_t(j) * g.nx + i;
      const double h = h_[c];
      if (!(h > 0)) continue;
      sum += 0.5 * k_most_ * arc_[i] * h * std::max(0.0, hu_[c]);
      if (remembers || (kx == 0 && ky == 0)) continue;
      const double ramp = 0.2 * std::sqrt(weight_[i] * h), p = 0.5 * weight_[i] * h * h;
      sum += p * ramp * (kx * sx / (2 * g.dx) + ky * sy / (2 * g.dy));
    }
  }
  return sum;
}

void Demands::step(double dt) {
  const double before = solver_.time();
  solver_.step(dt);
  look(solver_.time() - before);
}

void Demands::run(int steps) {
  for (int k = 0; k < steps; ++k) {
    const double dt = solver_.stable_dt();
    if (dt > 1e300) return;  // nothing moves
    step(dt);
  }
}

void Demands::look(double dt) {
  const Grid& g = case_.grid();
  solver_.gather(h_, hu_, hv_);
  for (std::size_t c = 0; c < h_.size(); ++c) worst_.finite = worst_.finite && std::isfinite(h_[c] + hu_[c] + hv_[c]);
  deepest_ = std::max(deepest_, *std::ranges::max_element(h_));
  const double floor = 1e-300;
  worst_.least =
      std::min({worst_.least, *std::ranges::min_element(h_) / (deepest_ + floor), solver_.min_depth() / (deepest_ + floor)});

  const Budget& b = solver_.budget();
  const double in = b.mass_boundary + b.mass_zone;
  passed_ += std::abs(in - mass_in_);
  mass_in_ = in;
  worst_.mass = std::max(worst_.mass, std::abs(solver_.volume() - volume0_ - in) / (volume0_ + passed_ + floor));
  worst_.clipped = b.mass_clipped / (volume0_ + passed_ + floor);

  double fastest = 0;
  for (std::size_t c = 0; c < h_.size(); ++c) {
    if (h_[c] < case_.settings.dry_depth) continue;
    fastest = std::max(fastest, std::hypot(hu_[c], hv_[c]) / h_[c]);
  }
  const double gravity = case_.settings.gravity;
  const double bound =
      u0_ + 4 * std::sqrt(k_most_ * gravity * deepest_) + 2 * std::sqrt(2 * gravity * drop_) + drive_ * (solver_.time() + 2 * dt);
  worst_.speed = std::max(worst_.speed, fastest / (bound + floor));

  if (!has_energy_) return;
  const double power = supply();
  supply_ += dt * std::max(power, power_) * g.dx * g.dy;
  power_ = power;
  double e = energy() - supply_;
  if (seam_ >= 0) e -= gravity * std::sin(case_.angle) * g.nx * g.dx * solver_.gauge(seam_);
  const double unit = std::abs(volume0_) * gravity * cell_drop_ + subject_.energy * std::abs(e0_) + floor;
  worst_.energy = std::max(worst_.energy, (e - least_e_) / unit);
  least_e_ = std::min(least_e_, e);
}

namespace {

// The worst figures of each test case, printed when all have run.
class Report : public testing::Environment {
 public:
  std::map<std::string, Worst> cases;
  void TearDown() override {
    for (const auto& [name, w] : cases) {
      std::printf("worst of %-44s mass %.1e, energy %.2e drops, speed %.3f, least depth %.1e\n", name.c_str(), w.mass, w.energy,
                  w.speed, w.least);
    }
  }
};
Report* const report = static_cast<Report*>(testing::AddGlobalTestEnvironment(new Report));

}  // namespace

void Demands::expect(const std::string& what, const Bounds& bounds) {
  EXPECT_TRUE(worst_.finite) << what;
  EXPECT_GE(worst_.least, 0) << what;
  EXPECT_EQ(worst_.clipped, 0) << what;
  EXPECT_LE(worst_.mass, 1e-12) << what;
  EXPECT_LE(worst_.energy, bounds.energy) << what;
  EXPECT_LE(worst_.speed, bounds.speed) << what;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = test->name();
  report->cases[name.substr(0, name.find('/')) + ", " + subject_.name].take(worst_);
}

bool same_mirrored(const FlowModel& a, const FlowModel& b) {
  const Grid& g = a.grid();
  std::vector<double> h, hu, hv, mh, mhu, mhv;
  a.gather(h, hu, hv);
  b.gather(mh, mhu, mhv);
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const std::size_t c = std::size_t(j) * g.nx + i, m = std::size_t(g.ny - 1 - j) * g.nx + i;
      if (h[c] != mh[m] || hu[c] != mhu[m] || hv[c] != -mhv[m]) return false;
    }
  }
  return a.time() == b.time();
}

}  // namespace couloir::test
