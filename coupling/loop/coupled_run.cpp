#include <algorithm>
#include <filesystem>
#include <future>

#include "coupling/loop/flow_side.hpp"
#include "coupling/loop/gauges.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/loop/momentum_book.hpp"
#include "coupling/loop/names.hpp"
#include "coupling/loop/stress_gauges.hpp"
#include "coupling/loop/zone_side.hpp"
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
    const std::vector<PlannedZone> planned = planned_zones(scene_);
    std::vector<CellBox> covered;
    for (const PlannedZone& zone : planned) {
      zones_.push_back(std::make_unique<ZoneSide>(scene_, options_, work_dir(), surface_, *flow_, zone, deepest,
                                                  [this](double time, const std::string& what) { tell(time, what); }));
      covered.push_back(zones_.back()->widest());
    }
    clock_ = std::make_unique<Clock>(zones_.front()->timestep(), scene_.grains.window, scene_.duration);

    RunStart begin;
    begin.surface = &surface_;
    begin.grid = grid;
    begin.bed = flow_->bed();
    begin.obstacles = obstacle_names(scene_);
    begin.measures = measures_ = flow_->measure(scene_, surface_, covered);
    begin.stress_gauges = gauges_ = stress_gauges(scene_, planned);
    begin.bulk_density = flow_->density();
    begin.window = clock_->length(1);
    begin.sample_interval = zones_.front()->grain_side().sample_interval();
    return begin;
  }

  // Each engine writes files of the same names.
  std::string work_dir() const {
    if (zones_.empty()) return options_.work_dir;
    const std::string path = options_.work_dir + "/zone_" + std::to_string(zones_.size());
    std::filesystem::create_directories(path);
    return path;
  }

  void window(std::int64_t index, WindowReport& w) override {
    for (auto& zone : zones_) zone->begin_window(w.time - w.length, clock_->steps(index), w.length);
    flow_->advance_to(w.time);
    for (auto& zone : zones_) zone->ask();
    advance_engines();
    for (auto& zone : zones_) zone->take_back();
    cpu_continuum_ = flow_->cpu();
    cpu_engine_ = 0;
    for (const auto& zone : zones_) cpu_engine_ += zone->grain_side().cpu();

    flow_->report(w);
    w.momentum.faces = 0;  // both sides of the faces are in the ledger: what they do not give each other is the residual
    w.stresses.resize(gauges_.size());
    double momentum = flow_->momentum();
    for (auto& zone : zones_) {
      zone->report(w);
      momentum += zone->momentum();
      if (!zone->covers()) continue;
      zone->grain_side().add_wall_forces(measures_, w.measures);
      add_stresses(*zone, w);
    }
    for (int k = 0; k < int(scene_.obstacles.size()); ++k) report_obstacle(k, w);
    for (const GaugeSpec& gauge : scene_.record.gauges)
      w.gauges.push_back(read_gauge(flow_->solver(), gauge, thin_depth(scene_)));
    book_.close(w.momentum, momentum);
  }

  // Side by side: each is a process of its own.
  void advance_engines() {
    if (zones_.size() == 1) return zones_.front()->advance();
    std::vector<std::future<void>> all;
    for (auto& zone : zones_) all.push_back(std::async(std::launch::async, [&zone] { zone->advance(); }));
    for (auto& one : all) one.wait();
    for (auto& one : all) one.get();
  }

  void add_stresses(const ZoneSide& zone, WindowReport& w) const {
    const std::vector<GaugeStress> read = zone.grain_side().stresses();
    for (std::size_t n = 0; n < read.size(); ++n)
      for (std::size_t k = 0; k < gauges_.size(); ++k)
        if (gauges_[k].obstacle == zone.gauges()[n].obstacle && gauges_[k].name == zone.gauges()[n].name) w.stresses[k] = read[n];
  }

  void report_obstacle(int k, WindowReport& w) {
    ObstacleForce force = flow_->force(k, w.length);
    w.force_samples.emplace_back();
    w.overtopped += flow_->overtopped(k);
    for (const auto& zone : zones_) {
      w.overtopped += zone->grain_side().overtopped(k);
      if (!zone->holds(k)) continue;
      const double depth = force.depth_on_top;
      force = zone->grain_side().force(k);
      w.force_samples.back() = zone->grain_side().force_samples(k);
      force.depth_on_top = depth;
    }
    w.obstacles.push_back(force);
  }

  FrameView frame() override {
    FrameView view = flow_->frame();
    grains_ = {};
    for (std::size_t n = 0; n < zones_.size(); ++n) {
      if (!zones_[n]->covers()) continue;
      view.zones.push_back(zones_[n]->box());
      if (zones_.size() == 1) {
        view.grains = zones_[n]->grains();
      } else {
        append(grains_, *zones_[n]->grains(), std::int64_t(n) * ids_of_a_zone);
        view.grains = &grains_;
      }
    }
    return view;
  }

  static void append(Grains& to, const Grains& from, std::int64_t shift) {
    for (const std::int64_t id : from.id) to.id.push_back(id + shift);
    const auto add = [](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); };
    add(to.x, from.x), add(to.y, from.y), add(to.z, from.z);
    add(to.vx, from.vx), add(to.vy, from.vy), add(to.vz, from.vz);
    add(to.radius, from.radius), add(to.driven, from.driven);
  }

  std::vector<GrainEngine*> engines() override {
    std::vector<GrainEngine*> all;
    for (auto& zone : zones_) all.push_back(zone->engine());
    return all;
  }

  void state(Archive& a) override {
    a(*flow_, book_);
    for (std::size_t n = 0; n < zones_.size(); ++n) zones_[n]->state(a, a.loading() ? engine_checkpoint(int(n)) : "");
  }

  void finish(RunEnd& end) override {
    end.costs = flow_->costs();
    for (const auto& zone : zones_) {
      const GrainSide& grains = zone->grain_side();
      end.peak_grains += grains.peak();
      end.particle_steps += grains.particle_steps();
      if (end.engine.empty()) end.engine = grains.engine();
    }
  }

  static constexpr std::int64_t ids_of_a_zone = 100'000'000;  // in frames, so that no two grains share one

  std::unique_ptr<FlowSide> flow_;
  std::vector<std::unique_ptr<ZoneSide>> zones_;
  std::vector<ForceMeasure> measures_;
  std::vector<StressGauge> gauges_;
  Grains grains_;  // of all zones, for a frame
  MomentumBook book_;
};

}  // namespace

std::unique_ptr<ModeRun> coupled_run(const Scene& s, const RunOptions& o, const std::vector<Observer*>& w) {
  return std::make_unique<CoupledRun>(s, o, w);
}

}  // namespace couloir
