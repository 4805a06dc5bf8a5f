#include <set>

#include "coupling/loop/force_measures.hpp"
#include "coupling/loop/grain_side.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/loop/momentum_book.hpp"
#include "coupling/loop/names.hpp"
#include "coupling/loop/stress_gauges.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/release.hpp"
#include "coupling/transfer/coarse_grain.hpp"
#include "coupling/transfer/domain_edge.hpp"
#include "coupling/transfer/fill.hpp"

namespace couloir {
namespace {

class GrainsRun : public ModeRun {
 public:
  using ModeRun::ModeRun;

 private:
  RunStart start() override {
    double deepest = 0;
    const double length = scene_.terrain.total_length(), half = scene_.terrain.width / 2, d = scene_.grains.diameter;
    for (double x = 0; x <= length; x += d)
      for (double y = -half; y <= half; y += d) deepest = std::max(deepest, release_at(scene_, x, y).h);

    FillBox domain{0, length, -half, half};
    for (std::size_t q = 0; q < 4; ++q) domain.walls[q] = scene_.sides[q].kind == SideSpec::Kind::wall;
    // What is left out along walls stands on top.
    const double least_length = release_volume(scene_) / (deepest * 2 * half);
    const double along = (domain.walls[0] + domain.walls[1]) * d / least_length;
    const double across = (domain.walls[2] + domain.walls[3]) * d / (2 * half);
    const double depth = (1 + along + across) * deepest;
    side_ = std::make_unique<GrainSide>(scene_, options_, surface_, depth, [this](const std::string& what) { tell(0, what); });
    gauges_ = stress_gauges(scene_, {});
    if (!resuming()) side_->start(setup(), gauges_);
    clock_ = std::make_unique<Clock>(side_->timestep(), scene_.grains.window, scene_.duration);
    grid_ = solver_settings(scene_).grid;

    const bool whole = scene_.release.kind == ReleaseSpec::Kind::uniform;
    const double wanted = whole ? 0 : scene_.material.density * release_volume(scene_);
    std::int64_t next_id = 1;
    request_.insert = fill(
        domain, [&](double x, double y) { return release_at(scene_, x, y); }, wanted, side_->table(), surface_, next_id);
    for (const NewGrain& g : request_.insert) {
      const double m = side_->table().grain_mass(g.radius);
      initial_mass_ += m;
      momentum_before_ += m * g.velocity[0];
    }
    inserted_ = long(request_.insert.size());

    std::array<bool, 4> open{};
    for (int q = 0; q < 4; ++q) open[q] = scene_.sides[q].open();
    edge_ = std::make_unique<DomainEdge>(open, length, scene_.terrain.width, side_->table().grain_density());

    RunStart begin;
    begin.surface = &surface_;
    begin.obstacles = obstacle_names(scene_);
    begin.measures = measures_ = wall_measures(scene_);
    begin.stress_gauges = gauges_;
    begin.bulk_density = side_->table().bulk_density();
    begin.window = clock_->length(1);
    begin.sample_interval = side_->sample_interval();
    return begin;
  }

  void window(std::int64_t index, WindowReport& w) override {
    request_.steps = clock_->steps(index);
    const Advanced& a = side_->advance(request_);
    cpu_engine_ = side_->cpu();
    request_.insert.clear();
    request_.remove.clear();
    const double left_before = edge_->momentum();
    edge_->take(a.grains, surface_, request_.remove);

    double mass = 0, momentum = 0;
    const std::set<std::int64_t> gone(request_.remove.begin(), request_.remove.end());
    for (std::size_t i = 0; i < a.grains.size(); ++i) {
      if (gone.count(a.grains.id[i])) continue;
      const double m = side_->table().grain_mass(a.grains.radius[i]);
      mass += m;
      momentum += m * a.grains.vx[i];
    }
    w.mass.initial = initial_mass_;
    w.mass.grains = mass;
    w.mass.left_domain = edge_->mass();
    w.momentum.storage = momentum - momentum_before_;
    // With the half kick that grains which left in the last window, and were taken out now, no longer get.
    w.momentum.boundary = a.drive_impulse[0] - (edge_->momentum() - left_before);
    w.momentum.gravity = mass_before() * scene_.gravity * surface_.gravity_direction().x() * w.length;
    w.momentum.bed = side_->impulse("bed");
    for (const char* side : side_surfaces) w.momentum.boundary += side_->impulse(side);
    for (int k = 0; k < int(scene_.obstacles.size()); ++k) {
      w.momentum.obstacles += side_->impulse(k);
      ObstacleForce force = side_->force(k);
      force.depth_on_top = depth_on_top(scene_.obstacles[k], a.grains);
      w.obstacles.push_back(force);
      w.force_samples.push_back(side_->force_samples(k));
      w.overtopped += side_->overtopped(k);
    }
    w.measures.resize(measures_.size());
    side_->add_wall_forces(measures_, w.measures);
    w.stresses = side_->stresses();
    mass_ = mass;
    momentum_before_ = momentum;
    book_.close(w.momentum, momentum);
    w.grains = long(a.grains.size());
    w.inserted = inserted_;
    w.engine_steps = a.step;
    w.max_overlap = a.max_overlap;
    w.max_speed = side_->max_speed();
  }

  double mass_before() const { return mass_ > 0 ? mass_ : initial_mass_; }

  // Means over squares of two diameters: a grain that lies in one cell is as deep as the cell is narrow.
  double depth_on_top(const ObstacleSpec& o, const Grains& g) const {
    const CellBox box{int((o.x - grid_.x0) / grid_.dx), int((o.x + o.length - grid_.x0) / grid_.dx + 0.5),
                      int((o.y - o.width / 2 - grid_.y0) / grid_.dy), int((o.y + o.width / 2 - grid_.y0) / grid_.dy + 0.5)};
    if (box.empty()) return 0;
    const CoarseGrained field =
        coarse_grain(g, grid_, box, surface_, side_->table().grain_density(), side_->table().bulk_density(), false);
    const auto cells = [&](double step) { return std::max(1, int(std::ceil(2 * scene_.grains.diameter / step - 1e-9))); };
    const int wide = cells(grid_.dx), high = cells(grid_.dy);
    double most = 0;
    for (int j0 = box.j0; j0 < box.j1; j0 += high)
      for (int i0 = box.i0; i0 < box.i1; i0 += wide) {
        double sum = 0;
        int count = 0;
        for (int j = j0; j < std::min(j0 + high, box.j1); ++j)
          for (int i = i0; i < std::min(i0 + wide, box.i1); ++i) {
            // The box around a mesh holds places beside it.
            if (o.shape == ObstacleSpec::Shape::mesh && !o.covers(grid_.x(i), grid_.y(j))) continue;
            sum += field.at(i, j).h, ++count;
          }
        if (count > 0) most = std::max(most, sum / count);
      }
    return most;
  }

  FrameView frame() override {
    FrameView view;
    if (side_->last().step > 0) {
      view.grains = &side_->last().grains;
    } else {
      for (const NewGrain& n : request_.insert) {
        start_.id.push_back(n.id);
        start_.x.push_back(n.position[0]);
        start_.y.push_back(n.position[1]);
        start_.z.push_back(n.position[2]);
        start_.vx.push_back(n.velocity[0]);
        start_.vy.push_back(n.velocity[1]);
        start_.vz.push_back(n.velocity[2]);
        start_.radius.push_back(n.radius);
        start_.driven.push_back(0);
      }
      view.grains = &start_;
    }
    return view;
  }

  EngineSetup setup() const { return engine_setup_whole(scene_, surface_, side_->table().grain_density(), options_.work_dir); }

  std::vector<GrainEngine*> engines() override { return {&side_->port()}; }

  void state(Archive& a) override {
    a(*side_, *edge_, book_, request_.insert, request_.remove, initial_mass_, mass_, momentum_before_, inserted_);
    if (a.loading()) side_->restore(setup(), gauges_, engine_checkpoint(0));
  }

  void finish(RunEnd& end) override {
    end.peak_grains = side_->peak();
    end.particle_steps = side_->particle_steps();
    end.engine = side_->engine();
  }

  std::unique_ptr<GrainSide> side_;
  std::unique_ptr<DomainEdge> edge_;
  AdvanceRequest request_;
  Grains start_;
  Grid grid_;
  MomentumBook book_;
  std::vector<ForceMeasure> measures_;
  std::vector<StressGauge> gauges_;
  double initial_mass_ = 0, mass_ = 0, momentum_before_ = 0;
  long inserted_ = 0;
};

}  // namespace

std::unique_ptr<ModeRun> grains_run(const Scene& s, const RunOptions& o, const std::vector<Observer*>& w) {
  return std::make_unique<GrainsRun>(s, o, w);
}

}  // namespace couloir
