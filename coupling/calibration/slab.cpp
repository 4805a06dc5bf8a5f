#include "coupling/calibration/slab.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "coupling/cases/share_out.hpp"
#include "coupling/engine/packing_cache.hpp"

namespace couloir {

namespace {

// Lies between z0 and the slab's top: the share of the mean speed that a grain at this height starts with.
double profile(const SlabSpec& s, double height) {
  if (s.base == SlabBase::flat) return 1;
  const double depth = std::clamp(height / s.depth, 0.0, 1.0);
  return 5.0 / 3 * (1 - std::pow(1 - depth, 1.5));  // Bagnold
}

std::vector<NewGrain> cut(const SlabSpec& s, const Packing& stock) {
  const double lift = s.base == SlabBase::rough ? 0.8 * s.stock.diameter : 0;  // most of the teeth's hollows fill up
  std::vector<NewGrain> grains;
  for (const Packing::Grain& g : stock.grains) {
    if (g.z > s.depth) continue;
    NewGrain n;
    n.id = static_cast<std::int64_t>(grains.size()) + 1;
    n.position = {g.x, g.y, g.z + lift};
    n.velocity = {s.speed * profile(s, g.z), 0, 0};
    n.radius = g.r;
    grains.push_back(n);
  }
  return grains;
}

EngineSetup slide_setup(const SlabSpec& s, const std::string& work_dir) {
  const PackingSpec& p = s.stock;
  EngineSetup e = grain_setup(p, work_dir);
  e.gravity = {slab_gravity * std::sin(s.slope), 0, -slab_gravity * std::cos(s.slope)};
  e.hi = {p.length, p.width, s.depth + 40 * p.diameter};
  e.friction = s.friction;
  e.rolling_friction = s.rolling_friction;
  if (s.base == SlabBase::flat)
    e.surfaces = {{"base", flat_bed(p.length, p.width, 10 * p.diameter), s.base_friction, s.base_rolling_friction}};
  else
    e.surfaces = {{"base", rough_base(p.length, p.width, p.diameter), 1, s.rolling_friction}};  // holds whatever lies on it
  return e;
}

struct Motion {
  double mass = 0, speed = 0, slip = 0;  // [kg], [m/s], [m/s] of the lowest layer
};

Motion motion(const SlabSpec& s, const Grains& g) {
  const double lowest = s.stock.diameter * (s.base == SlabBase::rough ? 2 : 1);
  Motion m;
  double below = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double mass = grain_mass(g.radius[i], s.stock.density);
    m.mass += mass;
    m.speed += mass * g.vx[i];
    if (g.z[i] > lowest) continue;
    below += mass;
    m.slip += mass * g.vx[i];
  }
  m.speed /= m.mass;
  if (below > 0) m.slip /= below;
  return m;
}

}  // namespace

std::vector<Triangle> rough_base(double length, double width, double diameter) {
  const int nx = std::max(3, static_cast<int>(std::lround(length / diameter))),
            ny = std::max(3, static_cast<int>(std::lround(width / diameter)));
  std::mt19937_64 random(20011);
  std::vector<double> heights(static_cast<std::size_t>(nx) * ny);
  for (double& h : heights) h = diameter * static_cast<double>(random() >> 11) * 0x1p-53;
  return relief(nx, ny, [&](int i, int j) {
    return Vec{length * i / nx, width * j / ny, heights[static_cast<std::size_t>((i % nx) * ny + j % ny)]};
  });
}

SlabCurve slide(const SlabSpec& s, GrainEngine& engine, const std::string& cache, const std::string& work_dir,
                const std::function<bool()>& stop) {
  const Packing stock = settled_packing(s.stock, engine, cache, work_dir, [&](double) {
    if (stop()) throw Stopped();
  });
  const EngineSetup setup = slide_setup(s, work_dir);
  const auto steps = [&](double time) { return std::max<std::int64_t>(1, std::llround(time / setup.timestep)); };
  AdvanceRequest request;
  request.insert = cut(s, stock);
  request.steps = steps(s.settling);
  SlabCurve curve;
  curve.grains = request.insert.size();
  curve.solid_fraction = stock.solid_fraction;
  engine.start(setup);
  curve.engine = engine.name();
  Advanced a = engine.advance(request);
  request.insert.clear();
  request.steps = steps(s.window);

  Motion before = motion(s, a.grains);
  const double span = static_cast<double>(request.steps) * setup.timestep, weight = slab_gravity * std::cos(s.slope);
  const double depth = before.mass / (s.stock.length * s.stock.width * s.stock.density * stock.solid_fraction);
  const double bagnold = 2.5 * s.stock.diameter / (depth * std::sqrt(stock.solid_fraction * weight * depth));
  for (double time = 0; time + 0.5 * span < s.duration; time += span) {
    if (stop()) throw Stopped();
    a = engine.advance(request);
    const Motion now = motion(s, a.grains);
    SlabPoint p;
    p.time = time + 0.5 * span;
    p.speed = 0.5 * (before.speed + now.speed);
    p.friction = std::tan(s.slope) - (now.speed - before.speed) / (span * weight);
    p.inertia = bagnold * p.speed;
    p.slip = now.speed != 0 ? now.slip / now.speed : 0;
    curve.points.push_back(p);
    before = now;
    if (s.base == SlabBase::rough && p.inertia < 1e-3) break;  // it rests: what holds it is less than friction
  }
  engine.stop();
  return curve;
}

std::string describe(const SlabSpec& s) {
  return fmt::format(
      "{} depth {:.17g} friction {:.17g} rolling_friction {:.17g} base_friction {:.17g} base_rolling_friction {:.17g} slope "
      "{:.17g} speed {:.17g} settling {:.17g} duration {:.17g} window {:.17g} of {}",
      s.base == SlabBase::flat ? "flat" : "rough", s.depth, s.friction, s.rolling_friction, s.base_friction,
      s.base_rolling_friction, s.slope, s.speed, s.settling, s.duration, s.window, describe(s.stock));
}

}  // namespace couloir
