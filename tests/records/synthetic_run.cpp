#include "synthetic_run.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include "coupling/records/forces_csv.hpp"
#include "coupling/records/records.hpp"
#include "coupling/records/summary.hpp"
#include "coupling/records/xdmf.hpp"

namespace couloir::testing {
namespace {

constexpr double kWallX = 0.62, kWallThick = 0.02, kWallWidth = 0.12, kWallHeight = 0.06, kDepth = 0.03, kDiameter = 0.005;
constexpr double kMass = 1.4;  // [kg] about what the heap holds at the bulk density below
constexpr double kZone[4] = {0.5, 0.7, -0.1, 0.1};

double centre(double time) {
  return 0.25 + 0.5 * time + 0.9 * time * time;
}
double speed(double time) {
  return 0.5 + 1.8 * time;
}

// The heap, longer with time; where the wall stands or shades there is nothing, before it the flow is dammed.
double depth_at(double x, double y, double time) {
  const double a = 0.18 + 0.25 * time, b = 0.12 + 0.1 * time;
  const double r = std::pow((x - centre(time)) / a, 2) + std::pow(y / b, 2);
  double h = r < 1 ? kDepth * (1 - r) / (1 + time) : 0;
  const bool behind = std::abs(y) < kWallWidth / 2;
  if (behind && x > kWallX) return 0;
  if (behind && h > 0) h += 0.03 * std::exp(-(kWallX - x) / 0.03) * std::min(1.0, time / 0.2);
  return h;
}

}  // namespace

SyntheticRun::SyntheticRun(Mode mode, double scale_) : surface(ReferenceSurface::chute(0.6, 0.9, 0.3, 0.3)), scale(scale_) {
  scene.title = "Heap onto a wall";
  scene.file = "scenes/heap.yaml";
  scene.text = "title: Heap onto a wall\n";
  scene.mode = mode;
  scene.terrain.kind = TerrainSpec::Kind::chute;
  scene.terrain.angle = 0.6;
  scene.terrain.slope = 0.9;
  scene.terrain.arc = 0.3;
  scene.terrain.runout = 0.3;
  scene.terrain.width = 0.5;
  scene.release.height = kDepth;
  scene.grains.diameter = kDiameter;
  scene.obstacles.push_back({"wall", kWallX, 0, kWallThick, kWallWidth, kWallHeight});
  scene.duration = windows * length;
  if (mode != Mode::grains) grid = {150, 50, 0.01, 0.01, 0.0, -0.25};
}

RunStart SyntheticRun::start() const {
  RunStart out;
  out.scene = &scene;
  out.surface = &surface;
  out.grid = grid;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const bool wall = grid.x(i) > kWallX && grid.x(i) < kWallX + kWallThick && std::abs(grid.y(j)) < kWallWidth / 2;
      out.bed.push_back(wall ? kWallHeight : 0);
    }
  out.obstacles = {"wall"};
  if (planes) out.planes_obstacle = 0;
  out.measures = {{"wall", "control_volume"}, {"left", "wall"}};
  if (stresses) out.stress_gauges = {{0, "wall", "middle", 1.5e-3}};
  out.effects = {{"curvature", true, "the surface has an arc of radius 0.5 m at x = 0.9 m"},
                 {"earth pressure", true, "the material's angles 40 and 30 deg differ"},
                 {"rotation", false, "grains are spheres and the scene asks for no spin output"}};
  out.bulk_density = 1400;
  out.window = length;
  if (scene.mode != Mode::continuum) out.sample_interval = length / samples_of_window;
  return out;
}

double SyntheticRun::force(double time) const {
  const double t = time - 0.1;
  if (t <= 1e-9) return 0;
  const long k = std::lround(time / length);
  const double rattle = k % 4 == 0 ? 4 : k % 4 == 2 ? -4 : 0;
  const double bump = t < 0.02 ? 40 * std::sin(std::numbers::pi * t / 0.02) : 0;
  return scale * (6 + bump + rattle);
}

std::vector<double> SyntheticRun::samples(double time) const {
  std::vector<double> out;
  for (int n = 0; n < samples_of_window; ++n) {
    const double tone = force(time) != 0 ? 3 * scale * std::sin(2 * std::numbers::pi * n / samples_of_window) : 0;
    out.push_back(force(time) + tone);
  }
  return out;
}

WindowReport SyntheticRun::window(long k) const {
  WindowReport w;
  w.index = k;
  w.length = length;
  w.time = (k + 1) * length;
  const double t = w.time, share = std::clamp((t - 0.1) / 0.2, 0.0, 1.0);
  const bool with_grains = scene.mode != Mode::continuum, with_flow = scene.mode != Mode::grains;
  w.mass.initial = kMass;
  w.mass.grains = scene.mode == Mode::grains ? kMass : with_grains ? 0.5 * share : 0;
  w.mass.left_domain = with_flow ? 0.2 * share : 0;
  w.mass.continuum = with_flow ? kMass - w.mass.grains - w.mass.left_domain : 0;
  w.mass.faces = with_flow && with_grains ? 1e-4 * share : 0;
  w.mass.continuum -= w.mass.faces;
  w.mass.continuum *= with_flow ? 1 + 1e-15 * (k % 7) : 1;
  w.momentum.gravity = kMass * 9.81 * std::sin(0.6) * length;
  w.momentum.bed = -0.6 * w.momentum.gravity;
  w.momentum.obstacles = -force(t) * length;
  w.momentum.storage = w.momentum.gravity + w.momentum.bed + w.momentum.obstacles;
  w.momentum.boundary = 0.1 * w.momentum.obstacles;  // so that the control volume has 0.9 of the force
  w.momentum.residual = 1e-9 * (1 + k % 5);
  w.momentum.scale = kMass * speed(t);
  w.obstacles.push_back({{force(t), 0.1 * force(t), -0.2 * force(t)}, t > 0.2 ? 0.004 : 0});
  if (with_grains) w.force_samples = {samples(t)};
  if (planes) {
    w.obstacles[0].overflow = 0.1 * t;
    w.obstacles[0].heap = 0.05 - 0.1 * std::abs(t - 0.1);
    w.obstacles[0].climbed = 0.08 - 0.1 * std::abs(t - 0.12);
  }
  if (stresses) w.stresses = {{2 * force(t), -0.5 * force(t), 0.1 * force(t)}};
  w.measures = {{1.5 * force(t), 0.25 * force(t)}, {0.125, -2 - force(t)}};
  w.grains = with_grains ? long(4000 * (scene.mode == Mode::grains ? 2.5 : share)) : 0;
  w.returned = with_grains ? long(800 * share * share) : 0;
  w.inserted = w.grains + w.returned;
  w.engine_steps = with_grains ? 40 * (k + 1) : 0;
  w.solver_steps = with_flow ? k + 1 : 0;
  w.cell_updates = 2 * 7500 * w.solver_steps;
  if (refined) w.levels = {{0, 0.01, 1, 7500}, {1, 0.005, 1, 1200}, {2, 0.0025, 1, 1600}};
  w.max_overlap = with_grains ? 0.03 * share : 0;
  w.max_speed = speed(t);
  w.min_depth = -1e-18;
  w.overtopped = 0.05 * share;
  return w;
}

std::vector<double> SyntheticRun::depth(double time) const {
  std::vector<double> h;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) h.push_back(depth_at(grid.x(i), grid.y(j), time));
  return h;
}

BlocksView SyntheticRun::blocks(double time) const {
  BlocksView out;
  out.places = {{0, 0, 0, 150, 50}, {1, 90, 30, 30, 40}, {2, 200, time > 0.2 ? 90 : 80, 40, 40}};
  for (const BlockPlace& b : out.places) {
    const Grid g = grid.refined(b.level);
    for (int j = b.j0; j < b.j0 + b.ny; ++j)
      for (int i = b.i0; i < b.i0 + b.nx; ++i) {
        const double h = depth_at(g.x(i), g.y(j), time);
        out.h.push_back(h), out.hu.push_back(h * speed(time)), out.hv.push_back(0.01 * h);
      }
  }
  return out;
}

Grains SyntheticRun::grains(double time) const {
  Grains out;
  const bool everywhere = scene.mode == Mode::grains;
  const double x0 = everywhere ? 0.0 : kZone[0], x1 = everywhere ? 0.9 : kZone[1], half = everywhere ? 0.2 : kZone[3];
  std::int64_t id = 0;
  for (double x = x0; x < x1; x += kDiameter)
    for (double y = -half + kDiameter / 2; y < half; y += kDiameter) {
      const double h = depth_at(x, y, time);
      for (double z = kDiameter / 2; z < h; z += kDiameter) {
        ++id;
        const double slow = x < kWallX && std::abs(y) < kWallWidth / 2 ? std::min(1.0, (kWallX - x) / 0.1) : 1;
        const double wobble = 0.0004 * std::sin(double(id) * 12.9898);
        out.id.push_back(id);
        out.x.push_back(x + wobble);
        out.y.push_back(y - wobble);
        out.z.push_back(z + 0.5 * wobble);
        out.vx.push_back(speed(time) * slow);
        out.vy.push_back(0.1 * y);
        out.vz.push_back(0);
        out.radius.push_back(0.5 * kDiameter * (1 + 0.1 * std::sin(double(id))));
        out.driven.push_back(!everywhere && x < kZone[0] + 2 * kDiameter);
      }
    }
  return out;
}

void SyntheticRun::play(const std::vector<Observer*>& observers, double from, double until, bool finish,
                        const std::string& status) const {
  const auto tell = [&](auto what) {
    for (Observer* o : observers) what(*o);
  };
  const auto frame = [&](double time, long index) {
    const std::vector<double> h = depth(time);
    std::vector<double> hu = h, hv = h;
    for (double& v : hu) v *= speed(time);
    for (double& v : hv) v *= 0.01;
    const Grains g = grains(time);
    FrameView view;
    view.time = time;
    view.index = index;
    if (scene.mode != Mode::grains) view.h = &h, view.hu = &hu, view.hv = &hv;
    const BlocksView fine = refined ? blocks(time) : BlocksView();
    if (refined) view.blocks = &fine;
    if (scene.mode == Mode::coupled) view.zones = {{50, 70, 15, 35}};
    if (scene.mode != Mode::continuum) view.grains = &g;
    tell([&](Observer& o) { o.on_frame(view); });
  };
  constexpr std::int64_t number = 3;
  RunStart begin = start();
  begin.resumed = from > 0;
  tell([&](Observer& o) { o.on_start(begin); });
  if (from > 0) {
    Archive a(number, saved);
    tell([&](Observer& o) { o.state(a); });
    tell([&](Observer& o) { o.on_resume({from, "resumed"}); });
  }
  if (from == 0) frame(0, 0);
  for (long k = std::lround(from / length); k < windows && (k + 1) * length <= until + 1e-9; ++k) {
    if (k == 99) tell([](Observer& o) { o.on_event({0.1, "the flow reaches the wall: its front is 1 mm from it"}); });
    if (k == 299) tell([](Observer& o) { o.on_event({0.3, "the zone grows to 220 mm: the jump is 3 d from its face"}); });
    const WindowReport report = window(k);
    tell([&](Observer& o) { o.on_window(report); });
    if ((k + 1) % frame_every == 0) frame(report.time, (k + 1) / frame_every);
    if (std::abs(report.time - checkpoint_at) > length / 2) continue;
    Archive a(number);
    tell([&](Observer& o) { o.state(a); });
    saved = a.bytes();
    tell([&](Observer& o) { o.on_checkpoint(number); });
  }
  if (!finish) return;
  RunEnd end;
  end.status = status;
  if (status != "done") end.reason = "stopped by the user";
  end.wall = 12;
  end.cpu = 20;
  end.cpu_continuum = 5;
  end.cpu_engine = 14;
  end.cpu_coupling = 1;
  end.peak_grains = scene.mode == Mode::continuum ? 0 : 10000;
  end.particle_steps = scene.mode == Mode::continuum ? 0 : 28000000;
  end.engine = scene.mode == Mode::continuum ? "" : "LIGGGHTS 3.8.0";
  tell([&](Observer& o) { o.on_finish(end); });
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "couloir-records-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder: " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
  std::filesystem::remove_all(path_, ignored);
}

void record(const SyntheticRun& run, const std::string& folder, const Started& started) {
  std::filesystem::create_directories(folder);
  Records records(folder + "/records.h5", "title: Heap onto a wall\n# complete\n", "", false, started);
  ForcesCsv forces(folder + "/forces.csv");
  Xdmf xdmf(folder);
  Summary summary(folder + "/summary.json");
  run.play({&records, &forces, &xdmf, &summary});
}

}  // namespace couloir::testing
