#pragma once
// What the three modes share: start, windows, frames, end.

#include <memory>

#include "coupling/loop/clock.hpp"
#include "coupling/loop/run.hpp"

namespace couloir {

// CPU time of this process [s].
double cpu_now();

class ModeRun {
 public:
  ModeRun(const Scene&, const RunOptions&, const std::vector<Observer*>&);
  virtual ~ModeRun() = default;
  RunEnd go();

 protected:
  virtual RunStart start() = 0;  // builds what the mode needs; the clock too
  virtual void window(std::int64_t index, WindowReport&) = 0;
  virtual FrameView frame() = 0;
  virtual void save() = 0;  // into work_dir, after an interrupt or an error
  virtual void finish(RunEnd&) = 0;

  void tell(const Event&);  // what comes before the start is told right after it
  void tell(double time, std::string what) { tell(Event{time, std::move(what)}); }

  const Scene& scene_;
  const RunOptions& options_;
  ReferenceSurface surface_;
  std::unique_ptr<Clock> clock_;
  double cpu_continuum_ = 0, cpu_engine_ = 0;  // [s]

 private:
  void end(RunEnd&, double wall_start, double cpu_start);
  const std::vector<Observer*>& observers_;
  std::vector<Event> early_;
  bool started_ = false;
};

std::unique_ptr<ModeRun> continuum_run(const Scene&, const RunOptions&, const std::vector<Observer*>&);
std::unique_ptr<ModeRun> grains_run(const Scene&, const RunOptions&, const std::vector<Observer*>&);
std::unique_ptr<ModeRun> coupled_run(const Scene&, const RunOptions&, const std::vector<Observer*>&);

}  // namespace couloir
