#include <cmath>

#include "coupling/loop/flow_side.hpp"
#include "coupling/loop/gauges.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/loop/momentum_book.hpp"
#include "coupling/loop/names.hpp"
#include "coupling/loop/zone_side.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/scene/depths.hpp"
#include "coupling/scene/inflow.hpp"

namespace couloir {
namespace {

class CoupledRun : public ModeRun {
 public:
  using ModeRun::ModeRun;

 private:
  RunStart start() override {
    flow_ = std::make_unique<FlowSide>(scene_, surface_, options_.threads);
    const Grid& grid = flow_->solver().grid();
    double deepest = 0;
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) deepest = std::max(deepest, flow_->solver().at(i, j).h);
    for (const SideSpec& side : scene_.sides) deepest = std::max(deepest, greatest_inflow(scene_, side).depth);
    const PlannedZone planned = planned_zone(scene_);
    zone_ = std::make_unique<ZoneSide>(scene_, options_, surface_, *flow_, planned, deepest,
                                       [this](double time, const std::string& what) { tell(time, what); });
    clock_ = std::make_unique<Clock>(zone_->timestep(), scene_.grains.window, scene_.duration);

    RunStart begin;
    begin.scene = &scene_;
    begin.surface = &surface_;
    begin.grid = grid;
    begin.bed = flow_->bed();
    begin.obstacles = obstacle_names(scene_);
    begin.measures = measures_ = flow_->measure(scene_, surface_, zone_->widest());
    begin.stress_gauges = zone_->gauges();
    begin.effects = make_plan(scene_).effects;
    begin.bulk_density = flow_->density();
    return begin;
  }

  void window(std::int64_t index, WindowReport& w) override {
    zone_->begin_window(w.time - w.length, clock_->steps(index), w.length);
    flow_->advance_to(w.time);
    zone_->advance();
    cpu_continuum_ = flow_->cpu();
    cpu_engine_ = zone_->grain_side().cpu();

    flow_->report(w);
    const bool jumped = zone_->jumped();
    if (jumped) {  // what the zone covers has changed sides: no force did that
      w.momentum.storage = 0;
      w.momentum.gravity = w.momentum.bed = w.momentum.boundary = w.momentum.obstacles = 0;
    }
    w.momentum.faces = 0;  // both sides of the faces are in the ledger: what they do not give each other is the residual
    zone_->report(w);
    for (int k = 0; k < int(scene_.obstacles.size()); ++k) report_obstacle(k, w);
    w.stresses = zone_->covers() ? zone_->grain_side().stresses() : std::vector<GaugeStress>(zone_->gauges().size());
    if (zone_->covers()) zone_->grain_side().add_wall_forces(measures_, w.measures);
    for (const GaugeSpec& gauge : scene_.record.gauges)
      w.gauges.push_back(read_gauge(flow_->solver(), gauge, thin_depth(scene_)));
    book_.close(w.momentum, flow_->momentum() + zone_->momentum());
  }

  void report_obstacle(int k, WindowReport& w) {
    ObstacleForce force = flow_->force(k, w.length);
    if (zone_->holds(k)) {
      const double depth = force.depth_on_top;
      force = zone_->grain_side().force(k);
      force.depth_on_top = depth;
    }
    w.obstacles.push_back(force);
    w.overtopped += flow_->overtopped(k) + zone_->grain_side().overtopped(k);
  }

  FrameView frame() override {
    FrameView view = flow_->frame();
    view.grains = zone_->grains();
    return view;
  }

  GrainEngine* engine() override { return zone_->engine(); }

  void state(Archive& a) override {
    a(*flow_, book_);
    zone_->state(a, a.loading() ? engine_checkpoint() : "");
  }

  void finish(RunEnd& end) override {
    const GrainSide& grains = zone_->grain_side();
    end.peak_grains = grains.peak();
    end.particle_steps = grains.particle_steps();
    end.engine = grains.engine();
  }

  std::unique_ptr<FlowSide> flow_;
  std::unique_ptr<ZoneSide> zone_;
  std::vector<ForceMeasure> measures_;
  MomentumBook book_;
};

}  // namespace

std::unique_ptr<ModeRun> coupled_run(const Scene& s, const RunOptions& o, const std::vector<Observer*>& w) {
  return std::make_unique<CoupledRun>(s, o, w);
}

}  // namespace couloir
