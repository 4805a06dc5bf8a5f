#pragma once
// A small box of grains with a floor and four walls, and a folder that goes away.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <string>

#include "coupling/engine/engine_error.hpp"
#include "coupling/engine/packing.hpp"
#include "coupling/engine/worker_engine.hpp"

namespace couloir::test {

constexpr double d = 0.004, r = 0.5 * d, density = 1120, g = 9.81;
constexpr GrainStiffness stiffness{d, 0.1, density, 5e6, 0.25};

// A test of the port, which is a test of each engine. In a test file:
//   struct Exchange : OnEngine {};
//   INSTANTIATE_TEST_SUITE_P(On, Exchange, engines, name_of_engine);
struct OnEngine : testing::TestWithParam<std::string> {
  static bool yade() { return GetParam() == "yade"; }
  static std::string worker() { return worker_path(GetParam()); }
  static std::vector<int> ranks() { return yade() ? std::vector{1} : std::vector{1, 2}; }
};
inline const auto engines = testing::Values("liggghts", "yade");
inline std::string name_of_engine(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

struct Folder {
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "couloir-engine-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code error;
    std::filesystem::remove_all(path, error);
  }
  std::string path;
};

inline std::vector<Triangle> rectangle(Vec o, Vec a, Vec b) {
  const auto at = [&](double u, double v) {
    Vec r;
    for (int k = 0; k < 3; ++k) r[k] = o[k] + u * a[k] + v * b[k];
    return r;
  };
  return {{at(0, 0), at(1, 0), at(1, 1)}, {at(0, 0), at(1, 1), at(0, 1)}};
}

inline EngineSetup box(const std::string& work_dir, int across = 8, double height = 0.08) {
  EngineSetup s;
  const double w = across * 1.12 * d;
  s.timestep = stable_timestep(ContactLaw::hertz, stiffness);
  s.gravity = {0, 0, -g};
  s.lo = {-d, -d, -d};
  s.hi = {w + d, w + d, height};
  s.density = density;
  s.max_radius = 0.55 * d;
  s.work_dir = work_dir;
  s.timeout = 60;
  s.surfaces = {{"floor", rectangle({0, 0, 0}, {w, 0, 0}, {0, w, 0}), 0.4, 0.15},
                {"x0", rectangle({0, 0, 0}, {0, w, 0}, {0, 0, height}), 0.5, 0.15},
                {"x1", rectangle({w, 0, 0}, {0, w, 0}, {0, 0, height}), 0.5, 0.15},
                {"y0", rectangle({0, 0, 0}, {w, 0, 0}, {0, 0, height}), 0.5, 0.15},
                {"y1", rectangle({0, w, 0}, {w, 0, 0}, {0, 0, height}), 0.5, 0.15}};
  return s;
}

inline std::vector<NewGrain> lattice(int across, int layers, std::int64_t first_id = 1, double z0 = 0.6 * d) {
  std::vector<NewGrain> grains;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < across; ++j) {
      for (int i = 0; i < across; ++i) {
        NewGrain n;
        n.id = first_id + static_cast<std::int64_t>(grains.size());
        const double wiggle = 0.02 * d * std::sin(17.0 * i + 5.0 * j + 11.0 * k);
        n.position = {(i + 0.5) * 1.12 * d + wiggle, (j + 0.5) * 1.12 * d - wiggle, z0 + k * 1.12 * d};
        n.velocity = {0.1 * std::cos(3.0 * i + j), 0.1 * std::sin(2.0 * j + k), -0.2};
        n.radius = 0.5 * d * (1 + 0.1 * std::sin(29.0 * i + 13.0 * j + 7.0 * k));
        grains.push_back(n);
      }
    }
  }
  return grains;
}

inline double mass(double r) {
  return 4.0 / 3.0 * std::numbers::pi * r * r * r * density;
}

inline double mass(const Grains& grains) {
  double m = 0;
  for (const double r : grains.radius) m += mass(r);
  return m;
}

inline Vec momentum(const Grains& grains) {
  Vec p{};
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double m = mass(grains.radius[i]);
    p[0] += m * grains.vx[i];
    p[1] += m * grains.vy[i];
    p[2] += m * grains.vz[i];
  }
  return p;
}

// [rad/s] of one grain of diameter d alone, from its energy.
inline double spin_of(const Advanced& a) {
  const Grains& all = a.grains;
  const double v2 = all.vx[0] * all.vx[0] + all.vy[0] * all.vy[0] + all.vz[0] * all.vz[0];
  return std::sqrt(std::max(0.0, (2 * a.kinetic_energy / mass(0.5 * d) - v2) / (0.1 * d * d)));
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

inline bool same_bits(const Grains& a, const Grains& b) {
  return a.id == b.id && same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z) && same_bits(a.vx, b.vx) &&
         same_bits(a.vy, b.vy) && same_bits(a.vz, b.vz) && same_bits(a.radius, b.radius) && a.driven == b.driven;
}

inline AdvanceRequest steps(std::int64_t n) {
  AdvanceRequest r;
  r.steps = n;
  return r;
}

// What the error says.
template <class F>
std::string error_of(F&& action) {
  try {
    action();
  } catch (const EngineError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace couloir::test
