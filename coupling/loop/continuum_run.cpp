#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "continuum/errors.hpp"
#include "coupling/loop/flow_side.hpp"
#include "coupling/loop/gauges.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/loop/momentum_book.hpp"
#include "coupling/loop/names.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/scene/depths.hpp"

namespace couloir {
namespace {

class ContinuumRun : public ModeRun {
 public:
  using ModeRun::ModeRun;

 private:
  RunStart start() override {
    flow_ = std::make_unique<FlowSide>(scene_, surface_, options_.threads, options_.ranks);
    clock_ = std::make_unique<Clock>(Clock::of_intervals(scene_.record.forces, scene_.duration));
    RunStart begin;
    begin.surface = &surface_;
    begin.grid = flow_->model().grid();
    begin.bed = flow_->bed();
    begin.obstacles = obstacle_names(scene_);
    begin.planes_obstacle = flow_->planes_obstacle();
    begin.measures = flow_->measure(scene_, surface_, {});
    begin.bulk_density = flow_->density();
    begin.window = clock_->length(1);
    return begin;
  }

  void window(std::int64_t, WindowReport& w) override {
    flow_->advance_to(w.time);
    cpu_continuum_ = flow_->cpu();
    flow_->report(w);
    // At rest: by what the weight would give in the window.
    const double weights = scene_.gravity * w.length;
    book_.close(w.momentum, flow_->reported_momentum(), w.mass.continuum * std::max(w.max_speed, weights));
    for (int k = 0; k < int(scene_.obstacles.size()); ++k) {
      w.obstacles.push_back(flow_->force(k, w.length));
      w.overtopped += flow_->overtopped(k);
    }
    for (const GaugeSpec& gauge : scene_.record.gauges) w.gauges.push_back(read_gauge(flow_->model(), gauge, thin_depth(scene_)));
    watch_overflow(w);
  }

  FrameView frame() override { return flow_->frame(); }
  void state(Archive& a) override { a(*flow_, book_, overflow_seen_, heap_seen_, last_time_); }
  void finish(RunEnd& end) override {
    end.costs = flow_->costs();
    if (end.status == "done") cpu_continuum_ = options_.ranks.total(cpu_continuum_);
    if (overflow_seen_) tell(last_time_, "warning: in all, " + overflow_sentence());
  }

  // Over its upper edges the method planes has nothing true to say, so it does not stay silent.
  void watch_overflow(const WindowReport& w) {
    last_time_ = w.time;
    const int k = flow_->planes_obstacle();
    if (k < 0) return;
    const ObstacleSpec& o = scene_.obstacles[k];
    const auto object = [&](bool& seen, const std::string& sentence) {
      if (o.overflow == "error") throw NumericsError(sentence);
      if (!seen) tell(w.time, "warning: " + sentence);
      seen = true;
    };
    if (flow_->overtopped(k) > negligible_overflow * w.mass.initial) object(overflow_seen_, overflow_sentence());
    if (w.obstacles[k].heap > o.height) object(heap_seen_, heap_sentence(o, w.obstacles[k].heap));
  }

  std::string overflow_sentence() const {
    const int k = flow_->planes_obstacle();
    const double mass = flow_->overtopped(k);
    return fmt::format(
        "{:.4g} kg ({:.3g} % of the release) came over the upper edges of {}, which method planes cannot describe; do not trust "
        "what "
        "lies behind it: lower eta, raise the obstacle, or use method step or mode coupled",
        mass, 100 * mass / flow_->initial_mass(), scene_.obstacles[k].name);
  }

  static std::string heap_sentence(const ObstacleSpec& o, double heap) {
    return fmt::format(
        "the heap on the slope before {} stands {:.4g} m deep, above its upper edge at {:.4g} m; method planes holds it back as "
        "an "
        "endless wall would: raise the obstacle, or use method step or mode coupled",
        o.name, heap, o.height);
  }

  static constexpr double negligible_overflow = 1e-6;  // share of the release
  bool overflow_seen_ = false, heap_seen_ = false;
  double last_time_ = 0;  // [s]
  std::unique_ptr<FlowSide> flow_;
  MomentumBook book_;
};

}  // namespace

std::unique_ptr<ModeRun> continuum_run(const Scene& s, const RunOptions& o, const std::vector<Observer*>& w) {
  return std::make_unique<ContinuumRun>(s, o, w);
}

}  // namespace couloir
