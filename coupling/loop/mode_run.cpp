#include "coupling/loop/mode_run.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>

#include "continuum/errors.hpp"
#include "coupling/engine/engine_error.hpp"
#include "coupling/loop/costs.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/plan/switches.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/reader.hpp"

namespace couloir {
namespace {

constexpr double kept_apart = 10;  // [s] of the clock, between checkpoints that change no bits

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

// An engine's message may go on with its log's tail, which is in the run's folder.
std::string first_line(const std::string& what) {
  return what.substr(0, what.find('\n'));
}

}  // namespace

double cpu_now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

ModeRun::ModeRun(const Scene& scene, const RunOptions& options, const std::vector<Observer*>& observers)
    : scene_(as_run(scene)),
      options_(options),
      surface_(reference_surface(scene_)),
      asked_(scene),
      observers_(observers),
      wall_start_(wall_now()),
      cpu_start_(cpu_now()),
      progress_{0, 0, Schedule(scene.record.frames), Schedule(checkpoint_interval(scene)), 0, 0} {}

void ModeRun::tell(const Event& event) {
  if (!started_) return early_.push_back(event);
  for (Observer* o : observers_) o->on_event(event);
}

void ModeRun::show(double time) {
  const double before = cpu_now();
  FrameView view = frame();
  view.time = time;
  view.index = progress_.frames_shown++;
  for (Observer* o : observers_) o->on_frame(view);
  progress_.records += cpu_now() - before;
}

RunStart ModeRun::begun() {
  RunStart begin = start();
  begin.scene = &asked_;
  begin.effects = make_plan(asked_).effects;
  return begin;
}

void ModeRun::set_out(RunStart& begin) {
  for (Observer* o : observers_) o->on_start(begin);
  started_ = true;
  for (const Event& event : early_) tell(event);
  for (const std::string& assumed : inflow_assumptions(scene_)) tell(0, "warning: " + assumed);
  for (const std::string& by_hand : switched_off(asked_)) tell(0, "warning: " + by_hand);
  progress_.set_up += cpu_now() - cpu_start_;
  if (progress_.frames.due(0)) show(0);
  progress_.checkpoints.due(0);
  if (keeps()) keep(0);
}

void ModeRun::go_back(RunStart& begin, const Return& back) {
  begin.resumed = true;
  for (Observer* o : observers_) o->on_start(begin);
  started_ = true;
  Archive a(number_, back.checkpoint.state);
  a(progress_);
  state(a);
  for (Observer* o : observers_) o->state(a);
  if (folder_ && !a.at_end()) throw CheckpointError("the checkpoint holds more than this run can take; start the run anew");
  kept_ = back.checkpoint.time;
  progress_.set_up += cpu_now() - cpu_start_;
  for (Observer* o : observers_) o->on_resume({kept_, back.reason});
}

// By simulated time, since an engine that writes a checkpoint goes on with other bits. A continuum does not: there the clock may
// say that it is too early, on all ranks the first one's.
bool ModeRun::due(double time) {
  if (!keeps() || !progress_.checkpoints.due(time)) return false;
  if (scene_.mode != Mode::continuum || scene_.record.checkpoint > 0) return true;
  std::vector<char> now{static_cast<char>(options_.ranks.first() && wall_now() - wall_kept_ >= kept_apart)};
  options_.ranks.any(now);
  return now[0] != 0;
}

bool ModeRun::any_engine() {
  const auto all = engines();
  return std::any_of(all.begin(), all.end(), [](const GrainEngine* e) { return e != nullptr; });
}

void ModeRun::keep(double time) {
  const double before = cpu_now();
  const std::int64_t number = number_ + 1;
  try {
    const auto all = engines();
    for (int k = 0; folder_ && k < int(all.size()); ++k)
      if (all[k]) all[k]->checkpoint(folder_->engine_file(number, k));
  } catch (const EngineReport& report) {  // it is well but for that
    throw CheckpointError(first_line(report.what()));
  }
  Archive a(number);
  Progress now = progress_;
  now.wall += wall_now() - wall_start_;
  now.cpu += cpu_now() - cpu_start_;
  a(now);
  state(a);
  for (Observer* o : observers_) o->state(a);
  if (folder_) {
    Checkpoint whole{number, time, options_.made_by, write_scene(asked_), a.bytes()};
    folder_->commit(whole);
  }
  for (Observer* o : observers_) o->on_checkpoint(number);
  number_ = number;
  kept_ = time;
  wall_kept_ = wall_now();
  progress_.checkpoints_made += cpu_now() - before;
}

void ModeRun::windows(RunEnd& result) {
  result.status = "done";
  const std::int64_t last = clock_->windows();
  for (std::int64_t k = progress_.window + 1; k <= last; ++k) {
    WindowReport report;
    report.index = long(k);
    report.time = clock_->time(k);
    report.length = clock_->length(k);
    const double before = cpu_now();
    window(k, report);
    const double after = cpu_now();
    for (Observer* o : observers_) o->on_window(report);
    progress_.in_windows += after - before;
    progress_.records += cpu_now() - after;
    require_balance(report);
    progress_.window = k;
    if (progress_.frames.due(report.time)) show(report.time);
    if (due(report.time) && k < last) keep(report.time);
    if (k < last && options_.interrupted()) {
      result.status = "interrupted";
      result.reason = "stopped by the user at t = " + std::to_string(report.time) + " s";
      // With an engine the last checkpoint has to do: another one here would be another run from here on.
      if (keeps() && !any_engine() && kept_ < report.time) keep(report.time);
      return;
    }
  }
}

void ModeRun::end(RunEnd& end) {
  const double own_continuum = cpu_continuum_;
  finish(end);
  const bool together = end.status == "done";  // else some rank may be gone
  end.checkpoint = kept_;
  end.wall = progress_.wall + wall_now() - wall_start_;
  end.cpu_continuum = cpu_continuum_;
  end.cpu_engine = cpu_engine_;
  const double cpu = progress_.cpu + cpu_now() - cpu_start_;
  end.cpu_coupling = (together ? options_.ranks.total(cpu) : cpu) - cpu_continuum_;
  end.cpu = cpu_continuum_ + cpu_engine_ + end.cpu_coupling;
  add_costs(end, cpu, own_continuum);
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

// `cpu`, `cpu_continuum`: of this rank, which stands for all.
void ModeRun::add_costs(RunEnd& end, double cpu, double cpu_continuum) const {
  scale_to(end.costs, end.cpu_continuum);
  if (end.cpu_engine > 0) end.costs.push_back({"engine", "grain_engine", end.cpu_engine});
  const Progress& p = progress_;
  const bool coupled = scene_.mode == Mode::coupled;
  const double ledgers = p.in_windows - cpu_continuum;
  const double rest = cpu - cpu_continuum - p.set_up - ledgers - p.records - p.checkpoints_made;
  std::vector<PartCost> others{{"set_up", "", p.set_up},
                               {coupled ? "exchange" : "ledgers", coupled ? "coupling" : "", ledgers},
                               {"records", "", p.records},
                               {"checkpoints", "", p.checkpoints_made},
                               {"closing", "", rest}};
  std::erase_if(others, [](const PartCost& c) { return c.seconds <= 0; });
  scale_to(others, end.cpu_coupling);
  end.costs.insert(end.costs.end(), others.begin(), others.end());
}

// The first error is the one to tell; what follows from it (a full disk, say) adds nothing.
void ModeRun::end_badly(RunEnd result, const char* what) {
  if (!started_) return;
  result.status = "failed";
  result.reason = first_line(what);
  try {
    end(result);
  } catch (const std::exception&) {
  }
}

RunEnd ModeRun::go(CheckpointFolder* folder, const Return* back, bool patient) {
  folder_ = folder;
  resuming_ = back != nullptr;
  if (back) number_ = back->checkpoint.number;
  RunEnd result;
  try {
    RunStart begin = begun();
    back ? go_back(begin, *back) : set_out(begin);
    windows(result);
    end(result);
    if (folder_ && result.status == "done") folder_->clear();
    return result;
  } catch (const EngineError& error) {
    if (patient && folder_ && kept_ >= 0) throw EngineLost(first_line(error.what()));
    end_badly(result, error.what());
    throw;
  } catch (const std::exception& error) {
    end_badly(result, error.what());
    throw;
  }
}

}  // namespace couloir
