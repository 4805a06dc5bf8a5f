#include <fstream>

#include "coupling/loop/flow_side.hpp"
#include "coupling/loop/gauges.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/loop/momentum_book.hpp"
#include "coupling/loop/names.hpp"
#include "coupling/loop/saved_state.hpp"
#include "coupling/plan/plan.hpp"

namespace couloir {
namespace {

class ContinuumRun : public ModeRun {
 public:
  using ModeRun::ModeRun;

 private:
  RunStart start() override {
    flow_ = std::make_unique<FlowSide>(scene_, surface_, options_.threads);
    clock_ = std::make_unique<Clock>(Clock::of_intervals(scene_.record.forces, scene_.duration));
    RunStart begin;
    begin.scene = &scene_;
    begin.surface = &surface_;
    begin.grid = flow_->model().grid();
    begin.bed = flow_->bed();
    begin.obstacles = obstacle_names(scene_);
    begin.measures = flow_->measure(scene_, surface_, {});
    begin.effects = make_plan(scene_).effects;
    begin.bulk_density = flow_->density();
    return begin;
  }

  void window(std::int64_t, WindowReport& w) override {
    flow_->advance_to(w.time);
    cpu_continuum_ = flow_->cpu();
    flow_->report(w);
    book_.close(w.momentum, flow_->momentum());
    for (int k = 0; k < int(scene_.obstacles.size()); ++k) {
      w.obstacles.push_back(flow_->force(k, w.length));
      w.overtopped += flow_->overtopped(k);
    }
    for (const GaugeSpec& gauge : scene_.record.gauges) w.gauges.push_back(read_gauge(flow_->model(), gauge));
  }

  FrameView frame() override { return flow_->frame(); }
  void save() override { save_bytes(options_.work_dir, "continuum.state", flow_->model().checkpoint()); }
  void finish(RunEnd&) override {}

  std::unique_ptr<FlowSide> flow_;
  MomentumBook book_;
};

}  // namespace

std::unique_ptr<ModeRun> continuum_run(const Scene& s, const RunOptions& o, const std::vector<Observer*>& w) {
  return std::make_unique<ContinuumRun>(s, o, w);
}

}  // namespace couloir
