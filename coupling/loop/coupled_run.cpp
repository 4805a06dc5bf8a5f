#include <fmt/format.h>

#include <cmath>

#include "coupling/loop/flow_side.hpp"
#include "coupling/loop/gauges.hpp"
#include "coupling/loop/grain_side.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/loop/momentum_book.hpp"
#include "coupling/loop/names.hpp"
#include "coupling/loop/stress_gauges.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/plan/release.hpp"
#include "coupling/scene/depths.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/transfer/domain_edge.hpp"
#include "coupling/transfer/zone.hpp"

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
    grains_ =
        std::make_unique<GrainSide>(scene_, options_, surface_, deepest, [this](const std::string& what) { tell(0, what); });
    clock_ = std::make_unique<Clock>(grains_->timestep(), scene_.grains.window, scene_.duration);
    place_zone(grid);

    RunStart begin;
    begin.scene = &scene_;
    begin.surface = &surface_;
    begin.grid = grid;
    begin.bed = flow_->bed();
    begin.obstacles = obstacle_names(scene_);
    begin.measures = measures_ = flow_->measure(scene_, surface_, settings_.box);
    begin.stress_gauges = gauges_ = stress_gauges(scene_, &box_);
    begin.effects = make_plan(scene_).effects;
    begin.bulk_density = flow_->density();
    begin.window = clock_->length(1);
    begin.sample_interval = grains_->sample_interval();
    return begin;
  }

  void place_zone(const Grid& grid) {
    const PlannedZone planned = planned_zone(scene_);
    settings_.box = planned.cells;
    box_ = planned.box;
    const bool touches[] = {settings_.box.i0 == 0, settings_.box.i1 == grid.nx, settings_.box.j0 == 0,
                            settings_.box.j1 == grid.ny};
    std::array<bool, 4> open{};
    for (int q = 0; q < 4; ++q) open[q] = touches[q] && scene_.sides[q].open();
    along_ = surface_.tangent(0.5 * (box_.x0 + box_.x1));
    grains_->look_along(along_);
    edge_ = std::make_unique<DomainEdge>(open, scene_.terrain.total_length(), scene_.terrain.width,
                                         grains_->table().grain_density(), along_);
    settings_.rim.diameter = scene_.grains.diameter;
    settings_.gravity = scene_.gravity;
    settings_.periodic_y =
        scene_.sides[2].kind == SideSpec::Kind::periodic && settings_.box.j0 == 0 && settings_.box.j1 == grid.ny;
  }

  // The flow is near when a cell within reach of the zone is wet: what it covers in two windows, and two cells.
  bool flow_is_near() const {
    Solver& solver = flow_->solver();
    const Grid& grid = solver.grid();
    const double reach = 2 * clock_->length(1) * solver.max_speed();
    const int mx = 2 + int(reach / grid.dx), my = 2 + int(reach / grid.dy);
    const CellBox& b = settings_.box;
    for (int j = std::max(0, b.j0 - my); j < std::min(grid.ny, b.j1 + my); ++j)
      for (int i = std::max(0, b.i0 - mx); i < std::min(grid.nx, b.i1 + mx); ++i)
        if (solver.at(i, j).h > 1e-3 * scene_.grains.diameter) return true;
    return false;
  }

  void make_zone() { zone_ = std::make_unique<Zone>(settings_, flow_->solver().grid(), surface_, grains_->table()); }

  EngineSetup zone_setup() const {
    return engine_setup_zone(scene_, surface_, box_, zone_->rim(), grains_->table().grain_density(), options_.work_dir);
  }

  void start_engine(double time) {
    make_zone();
    const double before = flow_->solver().volume();
    first_ = zone_->take_over(flow_->solver());
    grains_->start(zone_setup(), gauges_);
    for (const NewGrain& g : first_) {
      if (zone_->is_shadow(g.id)) continue;
      grain_mass_ += grains_->table().grain_mass(g.radius);
      grain_momentum_ += grains_->table().grain_mass(g.radius) * along_.dot(Eigen::Vector3d::Map(g.velocity.data()));
    }
    grain_momentum_ += zone_->faces_momentum();
    flow_->forget_covered();  // it has become the grains' by no force
    tell(time,
         fmt::format("grains start: the flow is within reach of the zone x {:.3f}..{:.3f} m, y {:.3f}..{:.3f} m; {} grains "
                     "replace {:.4g} kg of flow in it",
                     box_.x0, box_.x1, box_.y0, box_.y1, first_.size(), (before - flow_->solver().volume()) * flow_->density()));
  }

  void window(std::int64_t index, WindowReport& w) override {
    if (!zone_ && flow_is_near()) start_engine(w.time - w.length);
    double mass_before = 0;
    if (zone_) {
      mass_before = grain_mass_;
      zone_->begin_window(clock_->steps(index), w.length);
      zone_->impose(flow_->solver());
    }
    flow_->advance_to(w.time);
    cpu_continuum_ = flow_->cpu();
    if (zone_) advance_grains();
    flow_->report(w);
    w.momentum.faces = 0;  // both sides of the faces are in the ledger: what they do not give each other is the residual
    for (int k = 0; k < int(scene_.obstacles.size()); ++k) {
      const bool by_grains = zone_ && grains_->has_obstacle(k);
      ObstacleForce force = flow_->force(k, w.length);
      if (by_grains) {
        const double depth = force.depth_on_top;
        force = grains_->force(k);
        force.depth_on_top = depth;
        w.momentum.obstacles += grains_->impulse(k);
      }
      w.obstacles.push_back(force);
      w.force_samples.push_back(by_grains ? grains_->force_samples(k) : std::vector<double>());
      w.overtopped += flow_->overtopped(k) + grains_->overtopped(k);
    }
    double momentum = flow_->momentum();
    w.stresses = zone_ ? grains_->stresses() : std::vector<GaugeStress>(gauges_.size());
    if (zone_) {
      grains_->add_wall_forces(measures_, w.measures);
      const Advanced& a = grains_->last();
      grain_mass_ = zone_->grains_mass(a.grains);
      const double grain_momentum = zone_->grains_momentum(a.grains), faces_momentum = zone_->faces_momentum();
      w.mass.grains = grain_mass_;
      w.mass.faces = zone_->faces_mass();
      w.mass.left_domain += edge_->mass();
      w.momentum.storage += grain_momentum + faces_momentum - grain_momentum_;
      w.momentum.gravity +=
          0.5 * (mass_before + grain_mass_) * scene_.gravity * surface_.gravity_direction().dot(along_) * w.length;
      w.momentum.bed += grains_->impulse("bed");
      w.momentum.boundary -= edge_->momentum() - left_momentum_;
      for (const char* side : side_surfaces) w.momentum.boundary += grains_->impulse(side);
      left_momentum_ = edge_->momentum();
      grain_momentum_ = grain_momentum + faces_momentum;
      momentum += grain_momentum_;
      w.grains = long(a.grains.size());
      w.inserted = zone_->inserted();
      w.returned = zone_->returned();
      w.engine_steps = a.step;
      w.max_overlap = a.max_overlap;
      w.max_speed = std::max(w.max_speed, grains_->max_speed());
    }
    for (const GaugeSpec& gauge : scene_.record.gauges)
      w.gauges.push_back(read_gauge(flow_->solver(), gauge, thin_depth(scene_)));
    book_.close(w.momentum, momentum);
  }

  void advance_grains() {
    AdvanceRequest request = zone_->request(flow_->solver());
    request.insert.insert(request.insert.begin(), first_.begin(), first_.end());
    first_.clear();
    grains_->advance(request);
    cpu_engine_ = grains_->cpu();
    zone_->absorb(grains_->last(), flow_->solver());
    std::vector<std::int64_t> left;
    edge_->take(grains_->last().grains, surface_, left, [&](std::int64_t id) { return !zone_->is_shadow(id); });
    zone_->take_out(left);
  }

  FrameView frame() override {
    FrameView view = flow_->frame();
    if (zone_) view.grains = &grains_->last().grains;
    return view;
  }

  GrainEngine* engine() override { return zone_ ? &grains_->port() : nullptr; }

  void state(Archive& a) override {
    bool begun = zone_ != nullptr;
    a(*flow_, *grains_, *edge_, book_, begun, first_, grain_mass_, grain_momentum_, left_momentum_);
    if (a.loading() && begun) {
      make_zone();
      grains_->restore(zone_setup(), gauges_, engine_checkpoint());
    }
    if (begun) a(*zone_);
  }

  void finish(RunEnd& end) override {
    end.peak_grains = grains_->peak();
    end.particle_steps = grains_->particle_steps();
    end.engine = grains_->engine();
  }

  std::unique_ptr<FlowSide> flow_;
  std::unique_ptr<GrainSide> grains_;
  std::unique_ptr<Zone> zone_;
  std::unique_ptr<DomainEdge> edge_;
  ZoneSettings settings_;
  ZoneBox box_;
  Eigen::Vector3d along_;  // the slope in the zone
  std::vector<NewGrain> first_;
  std::vector<ForceMeasure> measures_;
  std::vector<StressGauge> gauges_;
  MomentumBook book_;
  double grain_mass_ = 0, grain_momentum_ = 0, left_momentum_ = 0;
};

}  // namespace

std::unique_ptr<ModeRun> coupled_run(const Scene& s, const RunOptions& o, const std::vector<Observer*>& w) {
  return std::make_unique<CoupledRun>(s, o, w);
}

}  // namespace couloir
