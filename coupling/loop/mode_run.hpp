#pragma once
// What the three modes share: start, windows, frames, end.

#include <memory>
#include <stdexcept>

#include "coupling/checkpoint/checkpoint_folder.hpp"
#include "coupling/loop/clock.hpp"
#include "coupling/loop/run.hpp"

namespace couloir {

// CPU time of this process [s].
double cpu_now();

class ModeRun {
 public:
  ModeRun(const Scene&, const RunOptions&, const std::vector<Observer*>&);
  virtual ~ModeRun() = default;

  // Going on from a checkpoint.
  struct Return {
    Checkpoint checkpoint;
    std::string reason;
  };
  // The engine failed, and there is a checkpoint to go on from. what(): the first line of the engine's words.
  struct EngineLost : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  // `folder`: where checkpoints go; null: nowhere, or another rank's business. `patient`: throws EngineLost, before on_finish.
  RunEnd go(CheckpointFolder* folder, const Return* back, bool patient);

 protected:
  virtual RunStart start() = 0;  // builds what the mode needs; the clock too. No engine where resuming()
  virtual void window(std::int64_t index, WindowReport&) = 0;
  virtual FrameView frame() = 0;
  virtual void state(Archive&) = 0;  // between two windows. Loading: after start(); restores the engine, too
  virtual std::vector<GrainEngine*> engines() { return {}; }  // by number, null where one does not run
  bool any_engine();
  virtual void finish(RunEnd&) = 0;

  bool resuming() const { return resuming_; }
  std::string engine_checkpoint(int engine) const { return folder_->engine_file(number_, engine); }

  void tell(const Event&);  // what comes before the start is told right after it
  void tell(double time, std::string what) { tell(Event{time, std::move(what)}); }

  const Scene scene_;  // as it runs (coupling/plan/switches.hpp)
  const RunOptions& options_;
  ReferenceSurface surface_;
  std::unique_ptr<Clock> clock_;
  double cpu_continuum_ = 0, cpu_engine_ = 0;  // [s]

 private:
  // How far it has come.
  struct Progress {
    std::int64_t window = 0;
    long frames_shown = 0;
    Schedule frames, checkpoints;
    double wall = 0, cpu = 0;  // [s] before this object's
    // [s] of processor time: to the first window, in windows, in observers, for checkpoints; before this object's and its own.
    double set_up = 0, in_windows = 0, records = 0, checkpoints_made = 0;
  };
  void set_out(RunStart&);
  void go_back(RunStart&, const Return&);
  void windows(RunEnd&);
  void show(double time);
  bool keeps() const { return !options_.checkpoints.empty(); }
  bool due(double time);
  void keep(double time);
  void end(RunEnd&);
  void add_costs(RunEnd&, double cpu, double cpu_continuum) const;
  void end_badly(RunEnd, const char* what);

  RunStart begun();

  const Scene& asked_;
  const std::vector<Observer*>& observers_;
  std::vector<Event> early_;
  bool started_ = false, resuming_ = false;
  CheckpointFolder* folder_ = nullptr;
  std::int64_t number_ = -1;  // of the last checkpoint
  double kept_ = -1;          // [s] its simulated time
  double wall_start_, cpu_start_, wall_kept_ = 0;
  Progress progress_;
};

std::unique_ptr<ModeRun> continuum_run(const Scene&, const RunOptions&, const std::vector<Observer*>&);
std::unique_ptr<ModeRun> grains_run(const Scene&, const RunOptions&, const std::vector<Observer*>&);
std::unique_ptr<ModeRun> coupled_run(const Scene&, const RunOptions&, const std::vector<Observer*>&);

}  // namespace couloir
