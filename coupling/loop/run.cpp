#include "coupling/loop/run.hpp"

#include <chrono>
#include <ctime>
#include <exception>

#include "continuum/errors.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/scene/inflow.hpp"

namespace couloir {
namespace {

double wall_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Mass is kept to round-off, or the run is not worth going on with.
void require_balance(const WindowReport& w) {
  constexpr double round_off = 1e-12;
  if (w.mass.relative_error() <= round_off) return;
  throw NumericsError("the mass ledger does not close at t = " + std::to_string(w.time) + " s: relative error " +
                      std::to_string(w.mass.relative_error() * 1e12) +
                      "e-12, allowed 1e-12; this is a fault of couloir, please report it with the scene");
}

}  // namespace

double cpu_now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

ModeRun::ModeRun(const Scene& scene, const RunOptions& options, const std::vector<Observer*>& observers)
    : scene_(scene), options_(options), surface_(reference_surface(scene)), observers_(observers) {}

void ModeRun::tell(const Event& event) {
  if (!started_) return early_.push_back(event);
  for (Observer* o : observers_) o->on_event(event);
}

void ModeRun::end(RunEnd& end, double wall_start, double cpu_start) {
  finish(end);
  const bool together = end.status == "done";  // else some rank may be gone
  end.wall = wall_now() - wall_start;
  end.cpu_continuum = cpu_continuum_;
  end.cpu_engine = cpu_engine_;
  const double cpu = cpu_now() - cpu_start;
  end.cpu_coupling = (together ? options_.ranks.total(cpu) : cpu) - cpu_continuum_;
  end.cpu = cpu_continuum_ + cpu_engine_ + end.cpu_coupling;
  // One that cannot write any more must not keep the others from it.
  std::exception_ptr failed;
  for (Observer* o : observers_) {
    try {
      o->on_finish(end);
    } catch (...) {
      if (!failed) failed = std::current_exception();
    }
  }
  if (failed) std::rethrow_exception(failed);
}

RunEnd ModeRun::go() {
  const double wall_start = wall_now(), cpu_start = cpu_now();
  RunEnd result;
  try {
    const RunStart begin = start();
    for (Observer* o : observers_) o->on_start(begin);
    started_ = true;
    for (const Event& event : early_) tell(event);
    for (const std::string& assumed : inflow_assumptions(scene_)) tell(0, "warning: " + assumed);
    Schedule frames(scene_.record.frames);
    long frame_index = 0;
    const auto show = [&](double time) {
      FrameView view = frame();
      view.time = time;
      view.index = frame_index++;
      for (Observer* o : observers_) o->on_frame(view);
    };
    if (frames.due(0)) show(0);

    result.status = "done";
    for (std::int64_t k = 1; k <= clock_->windows(); ++k) {
      WindowReport report;
      report.index = long(k);
      report.time = clock_->time(k);
      report.length = clock_->length(k);
      window(k, report);
      for (Observer* o : observers_) o->on_window(report);
      require_balance(report);
      if (frames.due(report.time)) show(report.time);
      if (options_.interrupted()) {
        result.status = "interrupted";
        result.reason = "stopped by the user at t = " + std::to_string(report.time) + " s";
        save();
        break;
      }
    }
    end(result, wall_start, cpu_start);
    return result;
  } catch (const std::exception& error) {
    if (started_) {
      result.status = "failed";
      const std::string what = error.what();
      result.reason = what.substr(0, what.find('\n'));  // the log's tail that may follow is in the run's folder
      // The first error is the one to tell; what follows from it (a full disk, say) adds nothing.
      try {
        save();
      } catch (const std::exception&) {
      }
      try {
        end(result, wall_start, cpu_start);
      } catch (const std::exception&) {
      }
    }
    throw;
  }
}

RunEnd run_scene(const Scene& scene, const RunOptions& options, const std::vector<Observer*>& observers) {
  const auto make = scene.mode == Mode::continuum ? continuum_run : scene.mode == Mode::grains ? grains_run : coupled_run;
  return make(scene, options, observers)->go();
}

}  // namespace couloir
