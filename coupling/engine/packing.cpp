#include "coupling/engine/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "coupling/engine/engine_error.hpp"
#include "coupling/engine/packing_cache.hpp"

namespace couloir {

namespace {

constexpr double gravity = 9.81;  // [m/s2]
constexpr double pi = std::numbers::pi;

double volume(double r) {
  return 4.0 / 3.0 * pi * r * r * r;
}

// The standard's distributions differ between libraries; this does not. Uniform in [0, 1).
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

// A loose lattice, shaken, that falls onto the bed: enough grains for the depth at a solid fraction of 0.58 with a layer to
// spare.
std::vector<NewGrain> loose_grains(const PackingSpec& s, double& top) {
  std::mt19937_64 random(static_cast<std::uint64_t>(s.seed));
  const double pitch = 1.03 * s.diameter * (1 + s.spread);
  const int nx = static_cast<int>(s.length / pitch), ny = static_cast<int>(s.width / pitch);
  if (nx < 2 || ny < 2) {
    throw EngineError(fmt::format(
        "a packing of {:g} m by {:g} m is too small for grains of {:g} m: make it at least three grains long and wide", s.length,
        s.width, s.diameter));
  }
  const double wanted = 0.58 * s.length * s.width * (s.depth + 1.5 * s.diameter);  // [m3]
  const double jitter = 0.02 * s.diameter, speed = 1.3 * std::sqrt(gravity * s.diameter);
  std::vector<NewGrain> grains;
  double have = 0;
  for (int k = 0; have < wanted; ++k) {
    for (int i = 0; i < nx && have < wanted; ++i) {
      for (int j = 0; j < ny && have < wanted; ++j) {
        NewGrain g;
        g.id = static_cast<std::int64_t>(grains.size()) + 1;
        g.radius = 0.5 * s.diameter * (1 + s.spread * (2 * uniform(random) - 1));
        g.position = {(i + 0.5) * s.length / nx + jitter * (uniform(random) - 0.5),
                      (j + 0.5) * s.width / ny + jitter * (uniform(random) - 0.5), 0.6 * pitch + k * pitch};
        g.velocity = {speed * (uniform(random) - 0.5), speed * (uniform(random) - 0.5), -speed};
        top = g.position[2];
        have += volume(g.radius);
        grains.push_back(g);
      }
    }
  }
  return grains;
}

// [m3] of a ball of radius r with its centre at height zc that lies below z
double volume_below(double z, double zc, double r) {
  const double t = std::clamp(z - zc, -r, r);
  return pi * (r * r * t - t * t * t / 3 + 2 * r * r * r / 3);
}

double solid_fraction(const Packing& p, double from, double to) {
  double v = 0;
  for (const auto& g : p.grains) v += volume_below(to, g.z, g.r) - volume_below(from, g.z, g.r);
  return v / (p.length * p.width * (to - from));
}

// The depth to which the block is full: the highest slab of one diameter that is at least nine tenths as dense as the middle.
double full_depth(const Packing& p, double diameter) {
  double top = 0;
  for (const auto& g : p.grains) top = std::max(top, g.z);
  const double middle = solid_fraction(p, 0.25 * top, 0.75 * top);
  double depth = top;
  while (depth > 2 * diameter && solid_fraction(p, depth - diameter, depth) < 0.9 * middle) depth -= 0.05 * diameter;
  return depth;
}

EngineSetup packing_setup(const PackingSpec& s, double top, const std::string& work_dir) {
  EngineSetup e = grain_setup(s, work_dir);
  e.timeout = s.timeout;
  e.gravity = {0, 0, -gravity};
  e.hi = {s.length, s.width, top + 4 * s.diameter};
  e.friction = s.friction;
  e.rolling_friction = s.rolling_friction;
  e.surfaces = {{"bed", flat_bed(s.length, s.width, 10 * s.diameter), s.base_friction, s.base_rolling_friction}};
  return e;
}

// Runs until the grains hardly move. Returns their last state.
Grains settle(const PackingSpec& s, GrainEngine& engine, const std::vector<NewGrain>& loose, double top,
              const std::string& work_dir, const std::function<void(double)>& progress) {
  const EngineSetup setup = packing_setup(s, top, work_dir);
  const double fall = std::sqrt(2 * top / gravity), longest = 10 * fall + 2;  // [s]
  const double still = 0.02 * std::sqrt(gravity * s.diameter);  // [m/s] rms, spin included; below it the block only sways
  double mass = 0;
  for (const NewGrain& g : loose) mass += s.density * volume(g.radius);
  engine.start(setup);
  AdvanceRequest request;
  request.insert = loose;
  request.steps = std::max<std::int64_t>(1, static_cast<std::int64_t>(0.05 * fall / setup.timestep));
  request.want_grains = false;
  double time = 0, first = 0;
  for (;;) {
    const Advanced a = engine.advance(request);
    request.insert.clear();
    time += static_cast<double>(request.steps) * setup.timestep;
    const double rms = std::sqrt(2 * a.kinetic_energy / mass);
    first = std::max(first, rms);
    if (time > fall && rms < still) break;
    if (time > longest) {
      throw EngineError(
          fmt::format("a packing did not come to rest within {:.3g} s: the grains still move at {:.2g} m/s; they need a way to "
                      "lose energy: lower "
                      "the restitution ({:g}), raise the friction ({:g}), or keep the rolling friction at 1 or below ({:g})",
                      longest, rms, setup.restitution, setup.friction, setup.rolling_friction));
    }
    // Grains fall for about `fall`, then calm down by orders of magnitude.
    const double calm = time > fall ? std::clamp(std::log(first / rms) / std::log(first / still), 0.0, 1.0) : 0.0;
    if (progress) progress(0.3 * std::min(1.0, time / fall) + 0.7 * calm);
  }
  request.steps = 0;
  request.want_grains = true;
  Grains grains = engine.advance(request).grains;
  engine.stop();
  return grains;
}

}  // namespace

std::vector<Triangle> relief(int nx, int ny, const std::function<Vec(int, int)>& node) {
  std::vector<Triangle> triangles;
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  return triangles;
}

std::vector<Triangle> flat_bed(double length, double width, double size) {
  const int nx = std::max(1, static_cast<int>(std::ceil(length / size))),
            ny = std::max(1, static_cast<int>(std::ceil(width / size)));
  return relief(nx, ny, [&](int i, int j) { return Vec{length * i / nx, width * j / ny, 0.0}; });
}

EngineSetup grain_setup(const PackingSpec& s, const std::string& work_dir) {
  EngineSetup e;
  const GrainStiffness grain{s.diameter, s.spread, s.density, s.youngs_modulus, s.poisson_ratio};
  e.timestep = stable_timestep(s.contact, grain);
  e.contact = s.contact;
  e.tangential_damping = s.tangential_damping;
  e.linear = linear_contact(grain, s.restitution);
  e.rotation = s.rotation;
  e.control = s.control;
  e.lo = {0, 0, -2 * s.diameter};
  e.periodic = {true, true, false};
  e.density = s.density;
  e.max_radius = 0.5 * s.diameter * (1 + s.spread);
  e.restitution = s.restitution;
  e.youngs_modulus = s.youngs_modulus;
  e.poisson_ratio = s.poisson_ratio;
  e.work_dir = work_dir;
  return e;
}

Packing settled_packing(const PackingSpec& spec, GrainEngine& engine, const std::string& cache, const std::string& work_dir,
                        const std::function<void(double)>& progress, const std::function<void(const std::string&)>& say) {
  if (std::optional<Packing> kept = read_packing(spec, cache)) return *kept;
  double top = 0;
  const std::vector<NewGrain> loose = loose_grains(spec, top);
  const Grains grains = settle(spec, engine, loose, top, work_dir, progress);
  Packing packing;
  packing.length = spec.length;
  packing.width = spec.width;
  const auto wrap = [](double x, double period) {
    const double w = x - period * std::floor(x / period);
    return w < period ? w : 0.0;
  };
  for (std::size_t i = 0; i < grains.size(); ++i) {
    packing.grains.push_back({wrap(grains.x[i], spec.length), wrap(grains.y[i], spec.width), grains.z[i], grains.radius[i]});
  }
  std::stable_sort(packing.grains.begin(), packing.grains.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  packing.depth = full_depth(packing, spec.diameter);
  if (packing.depth < spec.depth) {
    throw EngineError(fmt::format("a packing came out {:.3g} m deep where {:.3g} m were asked for", packing.depth, spec.depth));
  }
  packing.solid_fraction = solid_fraction(packing, spec.diameter, packing.depth - 2 * spec.diameter);
  if (!write_packing(spec, packing, cache) && say)
    say(fmt::format("the settled packing could not be kept in {} (read-only, or a full disk): the next run settles it again",
                    cache));
  return packing;
}

}  // namespace couloir
