// The rate of the LIGGGHTS worker behind the port against that of a plain LIGGGHTS script, on the same grains (bench/README.md).
//
//   settle ----> checkpoint --+--> worker: restore, 50 windows of 40 steps, all grains returned after each
//                             +--> plain:  liggghts -in script, 2000 steps in one run
//
// Counted is the CPU time of the engine's process less that of the same process over no steps: start-up cancels out.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/engine/packing.hpp"
#include "coupling/engine/worker_engine.hpp"
#include "coupling/workers/liggghts_script.hpp"

namespace couloir {
namespace {

constexpr double diameter = 0.005, spread = 0.1, density = 2650, g = 9.81;
constexpr int nx = 25, ny = 20, nz = 20;  // 10000 grains
constexpr double pitch = 1.12 * diameter, length = nx * pitch, width = ny * pitch, height = 0.3;
constexpr double tilt = 45;  // [deg]
constexpr int window = 40, steps = 2000;

struct Folder {
  Folder() {
    path = (std::filesystem::temp_directory_path() / "couloir-bench-XXXXXX").string();
    if (!mkdtemp(path.data())) throw std::runtime_error("no temporary folder could be made; set TMPDIR to one that is writable");
  }
  ~Folder() {
    std::error_code error;
    std::filesystem::remove_all(path, error);
  }
  std::string path;
};

std::vector<Triangle> rectangle(Vec o, Vec a, Vec b) {
  const auto at = [&](double u, double v) {
    Vec r;
    for (int k = 0; k < 3; ++k) r[k] = o[k] + u * a[k] + v * b[k];
    return r;
  };
  return {{at(0, 0), at(1, 0), at(1, 1)}, {at(0, 0), at(1, 1), at(0, 1)}};
}

// A floor and four walls; the box is tilted by turning gravity.
EngineSetup tilted_box(const std::string& work_dir) {
  const double a = tilt * std::numbers::pi / 180;
  EngineSetup s;
  s.timestep = stable_timestep(s.contact, {diameter, spread, density, s.youngs_modulus, s.poisson_ratio});
  s.gravity = {g * std::sin(a), 0, -g * std::cos(a)};
  s.lo = {-diameter, -diameter, -diameter};
  s.hi = {length + diameter, width + diameter, height};
  s.density = density;
  s.max_radius = 0.5 * diameter * (1 + spread);
  s.work_dir = work_dir;
  s.surfaces = {{"floor", rectangle({0, 0, 0}, {length, 0, 0}, {0, width, 0})},
                {"x0", rectangle({0, 0, 0}, {0, width, 0}, {0, 0, height})},
                {"x1", rectangle({length, 0, 0}, {0, width, 0}, {0, 0, height})},
                {"y0", rectangle({0, 0, 0}, {length, 0, 0}, {0, 0, height})},
                {"y1", rectangle({0, width, 0}, {length, 0, 0}, {0, 0, height})}};
  return s;
}

std::vector<NewGrain> loose_grains() {
  std::vector<NewGrain> grains;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        NewGrain n;
        n.id = static_cast<std::int64_t>(grains.size()) + 1;
        const double wiggle = 0.01 * diameter * std::sin(17.0 * i + 5.0 * j + 11.0 * k);
        n.position = {(i + 0.5) * pitch + wiggle, (j + 0.5) * pitch - wiggle, (k + 0.6) * pitch};
        n.velocity = {0.1 * std::cos(3.0 * i + j), 0.1 * std::sin(2.0 * j + k), -0.2};
        n.radius = 0.5 * diameter * (1 + spread * std::sin(29.0 * i + 13.0 * j + 7.0 * k));
        grains.push_back(n);
      }
    }
  }
  return grains;
}

// Runs until the grains hardly move (as coupling/engine/packing.cpp has it) and keeps that state. Returns the step reached.
std::int64_t settle(const EngineSetup& setup, const std::string& checkpoint) {
  AdvanceRequest request;
  request.insert = loose_grains();
  request.steps = 1000;
  request.want_grains = false;
  double mass = 0;
  for (const NewGrain& n : request.insert) mass += density * 4.0 / 3.0 * std::numbers::pi * n.radius * n.radius * n.radius;
  const double still = 0.02 * std::sqrt(g * diameter);  // [m/s] rms
  WorkerEngine engine(worker_path("liggghts"));
  engine.start(setup);
  for (;;) {
    const Advanced a = engine.advance(request);
    request.insert.clear();
    const double rms = std::sqrt(2 * a.kinetic_energy / mass), time = static_cast<double>(a.step) * setup.timestep;
    if (time > 0.3 && rms < still) {
      engine.checkpoint(checkpoint);
      std::printf("%s, %d grains of %g mm, settled after %.2f s (rms velocity %.2g m/s); time step %.3g s\n",
                  engine.name().c_str(), nx * ny * nz, 1e3 * diameter, time, rms, setup.timestep);
      return a.step;
    }
    if (time > 5) throw std::runtime_error(fmt::format("the grains did not settle in 5 s: they still move at {:.2g} m/s", rms));
  }
}

// [s] User and system time together: the kernel counts only their sum exactly.
double cpu_seconds(const rusage& r) {
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return seconds(r.ru_utime) + seconds(r.ru_stime);
}

double cpu_of_ended_children() {
  rusage r{};
  getrusage(RUSAGE_CHILDREN, &r);
  return cpu_seconds(r);
}

// [s] of CPU from start to end of the worker's process.
double run_worker(const EngineSetup& setup, const std::string& checkpoint, int run_steps, Grains& last) {
  const double before = cpu_of_ended_children();
  WorkerEngine engine(worker_path("liggghts"));
  engine.restore(setup, checkpoint);
  AdvanceRequest request;
  request.steps = window;
  for (int done = 0; done < run_steps; done += window) last = engine.advance(request).grains;
  engine.stop();
  return cpu_of_ended_children() - before;
}

// The worker's commands without our own fixes; then the run, and at its end the grains' positions into a file.
void write_plain_script(const EngineSetup& setup, const std::string& checkpoint, std::int64_t step, int run_steps,
                        const std::string& script, const std::string& positions) {
  std::ofstream out(script);
  for (const std::string& line : liggghts_script(setup, checkpoint, step)) {
    if (line.find(" couloir/") == std::string::npos) out << line << "\n";
  }
  out << "run " << run_steps << "\n";
  out << "dump last all custom 1 " << positions << " id x y z\n";
  out << "dump_modify last format \"%d %.17g %.17g %.17g\"\n";
  out << "run 0\n";
}

double run_plain(const std::string& script) {
  const pid_t pid = fork();
  if (pid == 0) {
    const int null = open("/dev/null", O_RDWR);
    for (int k = 0; k < 3; ++k) dup2(null, k);
    execlp("liggghts", "liggghts", "-in", script.c_str(), "-log", "none", "-screen", "/dev/null", nullptr);
    _exit(127);
  }
  int status = 0;
  rusage used{};
  if (pid < 0 || wait4(pid, &status, 0, &used) != pid) throw std::runtime_error("liggghts could not be started");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(fmt::format("liggghts -in {} failed (wait status {}): is liggghts on the PATH?", script, status));
  }
  return cpu_seconds(used);
}

// [m] The largest distance between a grain's place after the worker's run and after the plain one.
double largest_difference(const Grains& worker, const std::string& positions) {
  std::ifstream in(positions);
  std::string line;
  while (std::getline(in, line) && line.find("ITEM: ATOMS") == std::string::npos) {
  }
  std::map<std::int64_t, Vec> plain;
  std::int64_t id = 0;
  for (Vec x; in >> id >> x[0] >> x[1] >> x[2];) plain[id] = x;
  double most = 0;
  if (plain.size() != worker.size()) {
    throw std::runtime_error(
        fmt::format("the plain run ended with {} grains, the worker's with {}", plain.size(), worker.size()));
  }
  for (std::size_t i = 0; i < worker.size(); ++i) {
    const Vec& x = plain.at(worker.id[i]);
    most = std::max(most, std::hypot(x[0] - worker.x[i], x[1] - worker.y[i], x[2] - worker.z[i]));
  }
  return most;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

void measure(int repetitions) {
  // One rank needs no daemon beside it: for the plain run, too, as WorkerProcess sets it for the worker.
  for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_ess_singleton_isolated"})
    setenv(name, "1", 1);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);

  const Folder folder;
  const EngineSetup setup = tilted_box(folder.path);
  const std::string checkpoint = folder.path + "/settled", positions = folder.path + "/positions";
  const std::string idle_script = folder.path + "/idle.in", script = folder.path + "/plain.in";
  const std::int64_t step = settle(setup, checkpoint);
  write_plain_script(setup, checkpoint, step, 0, idle_script, positions);
  write_plain_script(setup, checkpoint, step, steps, script, positions);

  std::printf("%d steps each; the worker returns all grains every %d steps\n\n", steps, window);
  std::printf("              million particle-steps a CPU second         CPU [s] (start-up, subtracted)\n");
  std::printf("repetition       worker      plain      ratio          worker             plain\n");
  const double work = 1e-6 * static_cast<double>(nx * ny * nz) * steps;
  std::vector<double> worker_rates, plain_rates;
  double difference = 0;
  for (int k = 1; k <= repetitions; ++k) {
    Grains last;
    const double worker_idle = run_worker(setup, checkpoint, 0, last), plain_idle = run_plain(idle_script);
    const double worker = run_worker(setup, checkpoint, steps, last) - worker_idle, plain = run_plain(script) - plain_idle;
    worker_rates.push_back(work / worker);
    plain_rates.push_back(work / plain);
    std::printf("%-12d %10.3f %10.3f %10.3f     %6.2f (%.2f)     %6.2f (%.2f)\n", k, worker_rates.back(), plain_rates.back(),
                plain / worker, worker, worker_idle, plain, plain_idle);
    std::fflush(stdout);
    difference = std::max(difference, largest_difference(last, positions));
  }
  const double worker = median(worker_rates), plain = median(plain_rates);
  std::printf("%-12s %10.3f %10.3f %10.3f\n", "median", worker, plain, worker / plain);
  const double best_worker = *std::ranges::max_element(worker_rates), best_plain = *std::ranges::max_element(plain_rates);
  std::printf("%-12s %10.3f %10.3f %10.3f\n\n", "fastest", best_worker, best_plain, best_worker / best_plain);
  std::printf("largest distance between a grain's places after both runs: %.2g m\n", difference);
}

}  // namespace
}  // namespace couloir

int main(int argc, char** argv) {
  const int repetitions = argc == 2 ? std::atoi(argv[1]) : 3;
  if (argc > 2 || repetitions < 1) {
    std::fprintf(stderr, "usage: worker_rate [REPETITIONS], 3 if not given\n");
    return 2;
  }
  try {
    couloir::measure(repetitions);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "worker_rate: %s\n", e.what());
    return 1;
  }
  return 0;
}
