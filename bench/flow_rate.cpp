// How fast the scheme central_upwind is, and what that depends on (docs/performance.md). `couloir bench` prints it as a table.
//
// Counted are cell updates: cells times stages, the time step's choice included. best: the fastest of all repetitions, which says
// most where other programs run beside this one.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "bench/flow/bare_kernel.hpp"
#include "bench/flow/heap_bytes.hpp"
#include "bench/flow/wet_chute.hpp"
#include "continuum/isa/isa.hpp"

namespace couloir::bench {
namespace {

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Steps that take some 10 ms, and at least 4.
int steps_for(double cells) {
  return std::clamp(static_cast<int>(3e5 / cells), 4, 64);
}

// Sets, then times `work`, which returns what it did; until the benchmark has enough.
void measure(benchmark::State& state, double (*clock)(), const std::function<void()>& set, const std::function<double()>& work) {
  double done = 0, best = 0;
  for (auto _ : state) {
    set();
    const double start = clock(), amount = work(), took = clock() - start;
    state.SetIterationTime(took);
    done += amount;
    best = std::max(best, amount / took);
  }
  state.counters["rate"] = benchmark::Counter(done, benchmark::Counter::kIsRate);
  state.counters["best"] = best;
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(0.4);
}

void add(const std::string& name, const Scene& scene) {
  add(name, [scene](benchmark::State& state) {
    const long before = heap_bytes();
    Solver solver = solver_of(scene);
    const double coarse = static_cast<double>(scene.nx) * scene.ny, wet = coarse / (scene.dry * scene.dry);
    double cells = 0;
    for (const BlockPlace& b : solver.blocks()) cells += static_cast<double>(b.nx) * b.ny;
    state.counters["bytes_per_cell"] = static_cast<double>(heap_bytes() - before) / (cells > 0 ? cells : coarse);
    const int steps = steps_for(wet);
    const auto set = [&] {
      for (int j = 0; j < scene.ny; ++j) {
        for (int i = 0; i < scene.nx; ++i) solver.set(i, j, state_of(scene, i, j));
      }
    };
    measure(state, scene.threads == 1 ? thread_seconds : wall_seconds, set, [&] {
      const auto updates = solver.cell_updates();
      for (int k = 0; k < steps; ++k) solver.step(solver.stable_dt());
      return static_cast<double>(solver.cell_updates() - updates);
    });
    if (scene.dry > 1) {  // blocks beside wet ones are stepped, too
      const double stepped = static_cast<double>(solver.cell_updates()) / (2.0 * static_cast<double>(solver.steps()));
      state.counters["stepped_per_wet"] = stepped / wet;
    }
  });
}

void add_bare_kernel(const std::string& name, int nx, int ny) {
  add(name, [=](benchmark::State& state) {
    BareFlow flow(nx, ny, 9.81);
    Scene scene;
    scene.nx = nx, scene.ny = ny;
    const auto set = [&] { flow.set([&](int i, int j) { return state_of(scene, i, j); }); };
    const int steps = steps_for(static_cast<double>(nx) * ny);
    measure(state, thread_seconds, set, [&] {
      const long updates = flow.cell_updates();
      for (int k = 0; k < steps; ++k) flow.step();
      return static_cast<double>(flow.cell_updates() - updates);
    });
  });
}

// a = b + s c over arrays of so many bytes together: bytes read and written.
void add_stream(const std::string& name, double bytes) {
  add(name, [=](benchmark::State& state) {
    const auto n = static_cast<std::size_t>(bytes / (3 * sizeof(double)));
    std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
    const int passes = std::max(1, static_cast<int>(1e8 / bytes));
    measure(
        state, thread_seconds, [] {},
        [&] {
          for (int k = 0; k < passes; ++k) {
            double* to = a.data();
            const double *x = b.data(), *y = c.data();
            for (std::size_t i = 0; i < n; ++i) to[i] = x[i] + 3 * y[i];
            benchmark::ClobberMemory();
          }
          return static_cast<double>(passes) * static_cast<double>(n) * 3 * sizeof(double);
        });
  });
}

void add_effects() {
  Scene s;
  add("effect/none", s);
  s.friction = true;
  add("effect/friction", s);
  s.curvature = true;
  add("effect/friction+curvature", s);
  s = {};
  s.active_passive = true;
  add("effect/earth_pressure", s);
  s = {};
  s.relief = true;
  add("effect/relief", s);
  add("effect/all", all_physics());
  s = all_physics();
  s.relief = true;
  add("effect/all+relief", s);
  add_bare_kernel("effect/bare_kernel", s.nx, s.ny);
}

void add_sizes() {
  for (const bool bare : {false, true}) {
    for (const int n : {64, 128, 256, 512, 1024}) {
      Scene s = all_physics();
      s.nx = 2 * n, s.ny = n;
      const std::string size = std::to_string(s.nx) + "x" + std::to_string(s.ny);
      bare ? add_bare_kernel("size_bare_kernel/" + size, s.nx, s.ny) : add("size/" + size, s);
    }
  }
}

void add_others() {
  for (const int block : {8, 16, 32, 64, 128}) {
    Scene s = all_physics();
    s.block = block;
    add("block/" + std::to_string(block), s);
  }
  for (const int dry : {1, 2, 4, 8}) {
    Scene s = all_physics();
    s.nx = s.ny = 512, s.dry = dry;
    add("wet/1:" + std::to_string(dry * dry), s);
  }
  for (const int levels : {0, 1, 2}) {
    Scene s = all_physics();
    s.levels = levels;
    add("levels/" + std::to_string(levels + 1), s);
  }
  for (const int threads : {1, 2}) {
    Scene s = all_physics();
    s.threads = threads;
    add("threads/" + std::to_string(threads), s);
  }
  for (const double bytes : {24e3, 480e3, 6e6, 400e6})
    add_stream("stream/" + std::to_string(static_cast<int>(bytes / 1e3)) + "kB", bytes);
}

}  // namespace
}  // namespace couloir::bench

int main(int count, char** words) {
  using namespace couloir;
  benchmark::AddCustomContext("instruction_set", to_string(chosen_isa()));
  bench::add_effects();
  bench::add_sizes();
  bench::add_others();
  benchmark::Initialize(&count, words);
  if (benchmark::ReportUnrecognizedArguments(count, words)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
