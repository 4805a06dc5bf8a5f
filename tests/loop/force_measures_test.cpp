// The other measures of force: against exact forces, and against each other in whole runs of the continuum.

#include "coupling/loop/force_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "continuum/exact/normal_shock.hpp"
#include "coupling/plan/build.hpp"
#include "small_run.hpp"

namespace couloir {
namespace {

struct Measured : Watched {
  std::vector<ForceMeasure> list;
  void on_start(const RunStart& start) override { list = start.measures; }
  // Impulse [N s] between two times; of = name, kind.
  double impulse(const std::string& of, const std::string& kind, int component, double from = 0) const {
    double sum = 0;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (list[k].of == of && list[k].kind == kind)
        for (const WindowReport& w : windows)
          if (w.time > from * (1 + 1e-9)) sum += w.measures[k][component] * w.length;
    return sum;
  }
  bool has(const std::string& of, const std::string& kind) const {
    return std::ranges::any_of(list, [&](const ForceMeasure& m) { return m.of == of && m.kind == kind; });
  }
};

Scene scene_of(const std::string& text) {
  const std::string file = fresh_folder("measures") + "/scene.yaml";
  std::ofstream(file) << text;
  return read_scene(file, COULOIR_SOURCE_DIR "/dem_inputs/materials", {});
}

Measured run(const Scene& scene) {
  Measured watched;
  run_scene(scene, options_in(fresh_folder("measured")), {&watched});
  return watched;
}

const std::string water =
    "mode: continuum\nmaterial: {density: 1000 kg/m3, internal_friction_angle: 0 deg, basal_friction_angle: 0 deg}\n"
    "continuum: {cell: 5 mm, closure: hydraulic}\n";

// A lake before a ramp across the whole channel: rho g h^2/2 w. The bed's push and the control volume have it exactly, the
// dissertation's sum to the order of its midpoints.
TEST(ForceMeasures, LakeBeforeARamp) {
  const double h0 = 0.06, height = 0.08, width = 0.05, exact = 1000 * 9.81 * h0 * h0 / 2 * width;
  Scene scene = scene_of(water +
                         "terrain: {kind: flat, length: 500 mm, width: 50 mm}\nduration: 20 ms\n"
                         "release: {kind: uniform, height: 60 mm}\n"
                         "boundaries: {upstream: wall, downstream: wall, left: wall, right: wall}\n");
  ObstacleSpec ramp{"ramp", 0.2, 0, 0.3, 1, height};  // wider than the channel: no sides; it ends with the channel
  ramp.method = ObstacleSpec::Method::elevation;
  ramp.ramp = 0.1;
  ramp.length = 0.5;
  scene.obstacles.push_back(ramp);
  const ReferenceSurface surface = reference_surface(scene);
  Solver solver(solver_settings(scene), surface, step_bed(scene));
  const Elevation z = elevation(scene);
  solver.set([&](double x, double y) { return FlowState{std::max(0.0, h0 - z.at(x, y)), 0, 0}; });
  ForceMeasures measures(scene, surface, solver, {});
  solver.advance_to(0.02);
  const auto force = measures.read(solver, 0.02);
  const auto of = [&](const std::string& kind, const std::string& name) {
    for (std::size_t k = 0; k < force.size(); ++k)
      if (measures.list()[k].kind == kind && measures.list()[k].of == name) return force[k];
    ADD_FAILURE() << name << " has no " << kind;
    return std::array<double, 2>{};
  };
  EXPECT_NEAR(1000 * solver.obstacle_impulse(0)[0] / 0.02, exact, 1e-10 * exact);
  EXPECT_NEAR(of("control_volume", "ramp")[0], exact, 1e-10 * exact);
  EXPECT_NEAR(of("elevation", "ramp")[0], exact, 0.005 * exact);
  EXPECT_EQ(of("elevation_upstream", "ramp")[0], of("elevation", "ramp")[0]);
  EXPECT_NEAR(of("elevation", "ramp")[1], 0, 1e-12 * exact);
  EXPECT_NEAR(of("wall", "upstream")[0], -exact, 1e-10 * exact);
  EXPECT_NEAR(of("wall", "downstream")[0], 0, 1e-10 * exact);
  EXPECT_NEAR(of("wall", "left")[1], -of("wall", "right")[1], 1e-10 * exact);
  EXPECT_LT(of("wall", "left")[1], 0);
  std::printf("lake before a ramp of 20 cells: (7.1)/exact %.5f\n", of("elevation", "ramp")[0] / exact);
}

// references.md 2f, by a whole run: the domain's wall, and an obstacle across the channel by each method.
TEST(ForceMeasures, NormalShock) {
  const double zeta = std::atan(0.5), g = 9.81 * std::cos(zeta), h1 = 0.02, froude = 3, u1 = froude * std::sqrt(g * h1);
  const double eta = exact::normal_shock_depth_ratio(froude), speed = u1 / (eta - 1), width = 0.01;
  const double exact = 1500 * 0.5 * g * h1 * h1 * eta * eta * width, duration = 0.6 / speed;
  for (const std::string method : {"", "step", "elevation"}) {
    std::string text = fmt::format(
        "mode: continuum\nmaterial: {{density: 1500 kg/m3, internal_friction_angle: 30 deg, basal_friction_angle: {0:.17g} "
        "rad}}\n"
        "continuum: {{cell: 5 mm, closure: hydraulic}}\n"
        "terrain: {{kind: incline, angle: {0:.17g} rad, length: 1 m, width: 10 mm}}\n"
        "release: {{kind: uniform, height: 20 mm, velocity: {1:.17g} m/s}}\n"
        "boundaries: {{upstream: {{inflow: {{depth: 20 mm, velocity: {1:.17g} m/s}}}}, downstream: wall, left: wall, right: "
        "wall}}\n"
        "record: {{forces: 2 ms}}\nduration: {2:.17g} s\n",
        zeta, u1, duration);
    Scene scene = scene_of(text);
    if (!method.empty()) {
      ObstacleSpec o{"dam", 0.9, 0, 0.1, 1, 1.5};  // wider than the channel, to its end
      o.method = method == "step" ? ObstacleSpec::Method::step : ObstacleSpec::Method::elevation;
      scene.obstacles.push_back(o);
    }
    const Measured watched = run(scene);
    const double late = duration / 2, span = watched.windows.back().time - late;
    if (method.empty()) {
      const double force = watched.impulse("downstream", "wall", 0, late) / span;
      EXPECT_NEAR(force, exact, 0.01 * exact);
      std::printf("shock at the domain's wall: force/exact %.4f\n", force / exact);
      continue;
    }
    double own = 0;
    for (const WindowReport& w : watched.windows)
      if (w.time > late * (1 + 1e-9)) own += w.obstacles[0].force[0] * w.length;
    EXPECT_NEAR(own / span, exact, 0.01 * exact) << method;
    EXPECT_NEAR(watched.impulse("dam", "control_volume", 0, late), own, 1e-9 * own) << method;
    std::printf("shock at a dam by %s: force/exact %.4f\n", method.c_str(), own / span / exact);
  }
}

// Two bodies beside each other: every window's control volume is the obstacle's own force. Central upwind has one of each method.
TEST(ForceMeasures, AgreeInEveryWindow) {
  for (const std::string scheme : {"central_upwind", "noc"}) {
    const bool noc = scheme == "noc";
    const Scene scene = small_scene(
        "continuum", {{"continuum.scheme", scheme},
                      {"obstacles.wall.position", "[400 mm, -70 mm]"},
                      {"obstacles.wall.method", noc ? "elevation" : "step"},
                      {"obstacles.wedge", "{shape: tetrahedron, position: [300 mm, 40 mm], size: [69.28 mm, 80 mm, 40 mm]}"},
                      {"boundaries", "{left: wall}"}});
    const Measured watched = run(scene);
    ASSERT_EQ(watched.list.size(), noc ? 7u : 5u);
    EXPECT_TRUE(watched.has("wall", "control_volume") && watched.has("wedge", "control_volume"));
    EXPECT_TRUE(watched.has("wedge", "elevation") && watched.has("wedge", "elevation_upstream") && watched.has("left", "wall"));
    double largest[2] = {};
    for (const WindowReport& w : watched.windows) {
      ASSERT_LE(std::abs(w.momentum.residual), 1e-11 * w.momentum.scale) << scheme << " at " << w.time;
      for (int o : {0, 1}) {
        for (int k : {0, 1}) ASSERT_NEAR(w.measures[o][k], w.obstacles[o].force[k], 1e-9) << scheme << " at " << w.time;
        largest[o] = std::max(largest[o], w.obstacles[o].force[0]);
      }
    }
    const double felt = noc ? 0.01 : 0.1;  // noc lets the flow climb over cells this coarse
    EXPECT_GT(largest[0], felt);
    EXPECT_GT(largest[1], felt);
    EXPECT_GT(watched.windows.back().overtopped, 0);
    std::printf("%s: greatest force on wall and wedge %.2f, %.2f N\n", scheme.c_str(), largest[0], largest[1]);
  }
}

// Where blocks of four sizes touch, and the surface is steep beside level ground.
TEST(ForceMeasures, AgreeInEveryWindowOverFourLevels) {
  const Scene scene =
      read_scene(COULOIR_SOURCE_DIR "/tests/scenes/wedge_over_levels.yaml", COULOIR_SOURCE_DIR "/dem_inputs/materials", {});
  const Measured watched = run(scene);
  ASSERT_TRUE(watched.has("wedge", "control_volume"));
  double largest = 0;
  for (const WindowReport& w : watched.windows) {
    for (int k : {0, 1}) ASSERT_NEAR(w.measures[0][k], w.obstacles[0].force[k], 1e-9) << "at " << w.time;
    largest = std::max(largest, w.obstacles[0].force[0]);
  }
  EXPECT_GT(largest, 1);
  EXPECT_EQ(watched.windows.back().levels.size(), 5u);
}

// On the wedge's faces, once cells resolve the thin flow on them, the dissertation's sum is the bed's push.
TEST(ForceMeasures, SumOfTheSeedTendsToTheBedsPush) {
  double share[3] = {};
  for (const int n : {0, 1, 2}) {
    const Scene scene = small_scene(
        "continuum", {{"obstacles", "{wedge: {shape: tetrahedron, position: [300 mm, 0], size: [69.28 mm, 80 mm, 40 mm]}}"},
                      {"continuum.cell", n == 0   ? "10 mm"
                                         : n == 1 ? "5 mm"
                                                  : "2.5 mm"},
                      {"duration", "0.4 s"}});
    const Measured watched = run(scene);
    double push = 0;
    for (const WindowReport& w : watched.windows) push += w.obstacles[0].force[0] * w.length;
    const double sum = watched.impulse("wedge", "elevation", 0);
    EXPECT_GT(watched.impulse("wedge", "elevation_upstream", 0), sum);  // the back is pushed down the slope
    share[n] = sum / push;
    std::printf("wedge, %d cells across: impulse by (7.1) / by the bed's push %.3f\n", 8 << n, share[n]);
  }
  EXPECT_LT(1 - share[1], 0.75 * (1 - share[0]));
  EXPECT_LT(1 - share[2], 0.6 * (1 - share[1]));
  EXPECT_NEAR(2 * share[2] - share[1], 1, 0.05);  // extrapolated at first order
}

// Bodies whose boxes hold each other's cells, or the zone's, have no control volume.
TEST(ForceMeasures, OnlyWhereTheyMeanSomething) {
  const Overrides two{{"obstacles.post", "{position: [420 mm, 0], size: [20 mm, 20 mm, 40 mm], method: elevation}"}};
  Scene scene = small_scene("continuum", two);
  const ReferenceSurface surface = reference_surface(scene);
  Solver solver(solver_settings(scene), surface, step_bed(scene));
  const auto kinds = [&](const CellBox& zone) {
    std::string text;
    const ForceMeasures measures(scene, surface, solver, std::vector<CellBox>{zone});
    for (const ForceMeasure& m : measures.list()) text += m.of + " " + m.kind + ", ";
    return text;
  };
  EXPECT_EQ(kinds({}), "post elevation, post elevation_upstream, ");
  EXPECT_EQ(kinds({40, 50, 5, 15}), "");
  scene.obstacles.pop_back();
  EXPECT_EQ(kinds({}), "wall control_volume, ");
  EXPECT_EQ(kinds({30, 45, 5, 15}), "");
}

}  // namespace
}  // namespace couloir
