// A scene in the dissertation's units (2.47) and the same scene in SI units give the same numbers.

#include <cmath>
#include <cstdio>

#include "small_run.hpp"

namespace couloir {
namespace {

// What a run says, in units of its scales, under the names that the failures are told by.
struct Numbers {
  std::map<std::string, std::vector<double>> of;
  std::int64_t steps = 0, cell_updates = 0;
};

Scene twin(const std::string& file, const Overrides& overrides) {
  return read_scene(COULOIR_SOURCE_DIR "/tests/scenes/" + file, COULOIR_SOURCE_DIR "/dem_inputs/materials", overrides);
}

Numbers numbers_of(const Scene& scene, double length) {
  const Watched run = watch(scene, {});
  const double time = std::sqrt(length / scene.gravity), velocity = std::sqrt(length * scene.gravity);
  const double force = scene.material.density * scene.gravity * std::pow(length, 3);
  Numbers n;
  std::array<double, 2> impulse{};
  for (const WindowReport& w : run.windows) {
    n.of["times"].push_back(w.time / time);
    for (const int k : {0, 1}) {
      impulse[k] += w.obstacles.at(0).force[k] * w.length / (force * time);
      n.of["impulse"].push_back(impulse[k]);
    }
    for (const auto& f : w.measures)
      n.of["forces by other measures"].insert(n.of["forces by other measures"].end(), {f[0] / force, f[1] / force});
    for (const GaugeReading& g : w.gauges) {
      n.of["depth at gauges"].push_back(g.depth / length);
      n.of["velocity at gauges"].insert(n.of["velocity at gauges"].end(),
                                        {g.velocity_along / velocity, g.velocity_across / velocity});
    }
    n.of["greatest speed"].push_back(w.max_speed / velocity);
    n.of["mass"].push_back(w.mass.continuum / (scene.material.density * std::pow(length, 3)));
    n.steps = w.solver_steps, n.cell_updates = w.cell_updates;
  }
  for (const std::vector<double>& frame : run.frames) {
    const std::size_t cells = frame.size() / 3;
    for (std::size_t c = 0; c < cells; ++c) {
      const double h = frame[c] / length;
      n.of["depth"].push_back(h);
      for (const std::size_t k : {1, 2}) n.of["momentum"].push_back(frame[k * cells + c] / (length * velocity));
      // A velocity is a quotient: where the depth is all round-off it says nothing.
      for (const std::size_t k : {1, 2}) n.of["velocity"].push_back(h > 1e-4 ? frame[k * cells + c] / frame[c] / velocity : 0.0);
    }
  }
  return n;
}

double greatest(const std::vector<double>& list) {
  double most = 0;
  for (const double x : list) most = std::max(most, std::abs(x));
  return most;
}

// By the greatest of its kind.
void expect_same(const Numbers& a, const Numbers& b, double tolerance) {
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.cell_updates, b.cell_updates);
  ASSERT_EQ(a.of.size(), b.of.size());
  for (const auto& [name, one] : a.of) {
    const std::vector<double>& other = b.of.at(name);
    ASSERT_EQ(one.size(), other.size()) << name;
    double apart = 0;
    for (std::size_t k = 0; k < one.size(); ++k) apart = std::max(apart, std::abs(one[k] - other[k]));
    std::printf("  %-26s greatest %-10.4g apart by %.1e of it\n", name.c_str(), greatest(one), apart / greatest(one));
    EXPECT_GT(greatest(one), 0) << name;
    EXPECT_LE(apart, tolerance * greatest(one)) << name;
  }
}

struct Variant {
  const char* name;
  Overrides overrides;
  const char* duration = "9";
  const char* si_duration = "900 ms";
  Overrides with(const char* until) const {
    Overrides all = overrides;
    all.push_back({"duration", until});
    return all;
  }
};

class Scales : public testing::TestWithParam<Variant> {};

TEST_P(Scales, SiTwinGivesTheSameNumbers) {
  const Numbers bare = numbers_of(twin("twin_dimensionless.yaml", GetParam().with(GetParam().duration)), 0.0981);
  const Numbers si = numbers_of(twin("twin_si.yaml", GetParam().with(GetParam().si_duration)), 0.0981);
  EXPECT_GT(bare.steps, 100);
  EXPECT_GT(greatest(bare.of.at("impulse")), 1);
  expect_same(bare, si, 1e-12);
}

// Here the rows' width, rounded to 40 bits (grid_of), differs by up to 4.5e-13 of itself.
TEST_P(Scales, AnyLengthGivesTheSameNumbers) {
  const auto sized = [&](const char* length) {
    Overrides overrides = GetParam().with(GetParam().duration);
    overrides.push_back({"scales.length", length});
    return twin("twin_dimensionless.yaml", overrides);
  };
  const Numbers small = numbers_of(sized("33.33 mm"), 0.03333);
  expect_same(small, numbers_of(sized("1 m"), 1), 5e-12);
  expect_same(small, numbers_of(sized("250 m"), 250), 5e-12);
}

const Overrides by_elevation{{"obstacles.wall.method", "elevation"}};
const Overrides by_noc{{"continuum.scheme", "noc"}, {"obstacles.wall.method", "elevation"}};

INSTANTIATE_TEST_SUITE_P(Of, Scales,
                         testing::Values(Variant{"step", {}}, Variant{"elevation", by_elevation}, Variant{"noc", by_noc}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace couloir
