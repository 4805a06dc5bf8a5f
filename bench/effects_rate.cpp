// What each effect of the continuum costs, on and off: cell updates per second of one wet scene (bench/README.md).
//
// effects_rate                the solver as it is
// effects_rate_bare           the same built without friction, earth pressure, curvature and relief
// (continuum/scheme/effects.hpp) effects_rate_no_curvature   built without curvature alone, which is a part of friction

#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <memory>
#include <numbers>
#include <string>

#include "continuum/noc/noc_solver.hpp"
#include "continuum/scheme/effects.hpp"
#include "continuum/solver.hpp"

namespace couloir {
namespace {

constexpr double deg = std::numbers::pi / 180, depth = 0.05;
constexpr int nx = 256, ny = 128, steps = 16;
constexpr double cell = 0.01;

struct Scene {
  bool friction = false, active_passive = false, curvature = false, arc = false, relief = false;
  bool noc = false;
  int rows = ny;
};

std::unique_ptr<FlowModel> flow_of(const Scene& s) {
  SolverSettings settings;
  settings.grid = {nx, s.rows, cell, cell, 0, 0};
  settings.sides[2].kind = settings.sides[3].kind = Side::Kind::periodic;
  settings.dry_depth = 1e-6 * depth;
  if (s.active_passive) settings.closure.earth_pressure = EarthPressure::active_passive(37 * deg, 24 * deg);
  settings.closure.tan_delta = s.friction ? std::tan(24 * deg) : 0;
  settings.closure.curvature = s.curvature;
  const double length = nx * cell;
  const ReferenceSurface surface = s.arc ? ReferenceSurface::chute(35 * deg, 0.1 * length, 0.8 * length, 0.1 * length)
                                         : ReferenceSurface::incline(35 * deg, length);
  const auto hills = [](double x, double y) {
    return 0.005 * (1 + std::sin(40 * x) * std::cos(2 * std::numbers::pi * y / (ny * cell)));
  };
  if (s.noc) {
    NocBed bed;
    if (s.relief) bed.obstacles.push_back(hills);
    return std::make_unique<NocSolver>(settings, surface, bed);
  }
  StepBed bed;
  for (int j = 0; s.relief && j < s.rows; ++j) {
    for (int i = 0; i < nx; ++i) bed.elevation.push_back(hills(settings.grid.x(i), settings.grid.y(j)));
  }
  return std::make_unique<Solver>(settings, surface, bed);
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// The state after the steps as one number, the same for the same bits.
double checksum(const FlowModel& flow) {
  std::vector<double> h, hu, hv;
  flow.gather(h, hu, hv);
  double sum = 0;
  for (std::size_t c = 0; c < h.size(); ++c) sum += static_cast<double>(c % 977 + 1) * (h[c] + hu[c] + 3 * hv[c]);
  return sum;
}

void rate(benchmark::State& state, const Scene& scene) {
  const auto flow = flow_of(scene);
  double updates = 0;
  for (auto _ : state) {
    flow->set([](double x, double y) {
      return FlowState{depth, (1 + 0.1 * std::sin(20 * x)) * depth,
                       0.05 * std::cos(2 * std::numbers::pi * y / (ny * cell)) * depth};
    });
    const std::int64_t before = flow->cell_updates();
    const double start = cpu_seconds();
    for (int k = 0; k < steps; ++k) flow->step(flow->stable_dt());
    state.SetIterationTime(cpu_seconds() - start);
    updates += static_cast<double>(flow->cell_updates() - before);
  }
  state.counters["updates"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
  state.counters["checksum"] = checksum(*flow);
}

void add(const std::string& name, const Scene& scene) {
  benchmark::RegisterBenchmark(name.c_str(), [scene](benchmark::State& state) { rate(state, scene); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->MinTime(0.3);
}

}  // namespace
}  // namespace couloir

int main(int count, char** words) {
  using namespace couloir;
  for (const bool noc : {false, true}) {
    const auto add_to = [&](const std::string& name, Scene scene) {
      scene.noc = noc;
      add((noc ? "noc/" : "") + name, scene);
    };
    add_to("bare", {});
    if (built::friction) add_to("arc", {.friction = true, .arc = true});
    if (!built::all || !built::curvature) continue;
    add_to("friction", {.friction = true});
    add_to("earth_pressure", {.active_passive = true});
    add_to("curvature", {.friction = true, .curvature = true, .arc = true});
    add_to("relief", {.relief = true});
    add_to("one_row", {.rows = 1});
  }
  benchmark::Initialize(&count, words);
  if (benchmark::ReportUnrecognizedArguments(count, words)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
