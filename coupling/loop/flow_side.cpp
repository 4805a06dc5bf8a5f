#include "coupling/loop/flow_side.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/planes/planes_model.hpp"
#include "coupling/loop/flow_models.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/release.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {

FlowSide::FlowSide(const Scene& scene, const ReferenceSurface& surface, int threads) : density_(scene.material.density) {
  const StepBed bed = step_bed(scene);
  model_ = flow_model(scene, surface, bed, threads);
  solver_ = dynamic_cast<Solver*>(model_.get());
  planes_ = dynamic_cast<PlanesModel*>(model_.get());
  planes_obstacle_ = couloir::planes_obstacle(scene);
  const Grid& grid = model_->grid();

  bed_.assign(std::size_t(grid.nx) * grid.ny, 0.0);
  if (!bed.elevation.empty()) bed_ = bed.elevation;
  for (std::size_t n = 0; n < scene.obstacles.size(); ++n) {
    const ObstacleSpec& o = scene.obstacles[n];
    lay_top(o, int(n), bed);
    gauge_.push_back(add_gauge(o));
    impulse_.push_back({0, 0});
  }

  model_->set([&](double x, double y) { return release_at(scene, x, y); });
  // The cells' sampling of the release is off by its edge; the depth is scaled so that the mass is exact.
  const double wanted = release_volume(scene), sampled = model_->volume();
  if (wanted > 0 && !(sampled > 0)) {
    throw SceneError(scene.places.of("release") +
                     ": the release lies between the centres of the cells, so that the mesh does not see it; use smaller cells");
  }
  if (wanted > 0 && sampled > 0 && scene.release.kind != ReleaseSpec::Kind::uniform) {
    const double scale = wanted / sampled;
    model_->set([&](double x, double y) {
      FlowState q = release_at(scene, x, y);
      return FlowState{scale * q.h, scale * q.hu, scale * q.hv};
    });
  }
  model_->gather(h_, hu_, hv_);
  least_climbing_ = std::max(1e-6, 0.01 * *std::ranges::max_element(h_));
  initial_mass_ = density_ * model_->volume();
  momentum_before_ = momentum();
}

// The top of a step is its footprint; that of a smooth body are its highest cells: a plateau, or the cells around a peak.
void FlowSide::lay_top(const ObstacleSpec& o, int id, const StepBed& bed) {
  const Grid& grid = model_->grid();
  const auto at = [&](int i, int j) { return std::size_t(j) * grid.nx + i; };
  const bool smooth = o.method == ObstacleSpec::Method::elevation;
  double highest = 0;
  for (std::size_t c = 0; smooth && c < bed.owner.size(); ++c) {
    if (bed.owner[c] == id) highest = std::max(highest, bed.elevation[c]);
  }
  std::vector<Cell> top;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const double x = grid.x(i), y = grid.y(j);
      const bool step = !smooth && bed.obstacles[id].covers(x, y);
      if (step) bed_[at(i, j)] += o.height;
      if (step || (smooth && bed.owner[at(i, j)] == id && bed.elevation[at(i, j)] >= 0.99 * highest)) top.push_back({i, j});
    }
  top_.push_back(std::move(top));
}

// Across the obstacle at its crest: the x-face nearest to it (downstream of two), the rows of its width there.
int FlowSide::add_gauge(const ObstacleSpec& o) {
  const Grid& grid = model_->grid();
  const double half = 0.5 * o.crest_width();
  const int i = int(std::floor((o.crest_x() - grid.x0) / grid.dx + 0.5 + 1e-9));
  int j0 = grid.ny, j1 = 0;
  for (int j = 0; j < grid.ny; ++j)
    if (grid.y(j) >= o.y - half && grid.y(j) <= o.y + half) j0 = std::min(j0, j), j1 = j + 1;
  if (j0 >= j1) j0 = std::clamp(int(std::floor((o.y - grid.y0) / grid.dy)), 0, grid.ny - 1), j1 = j0 + 1;  // narrower than a row
  return model_->add_gauge(std::clamp(i, 0, grid.nx), j0, j1);
}

const std::vector<ForceMeasure>& FlowSide::measure(const Scene& scene, const ReferenceSurface& surface, const CellBox& zone) {
  measures_.emplace(scene, surface, *model_, zone);
  return measures_->list();
}

void FlowSide::advance_to(double t) {
  const double before = cpu_now();
  model_->advance_to(t);
  cpu_ += cpu_now() - before;
}

double FlowSide::momentum() const {
  return density_ * model_->momentum()[0];
}

void FlowSide::report(WindowReport& w) {
  const Budget& b = model_->budget();
  // Inflow sides and all others apart: what goes out downstream is no smaller inflow.
  inflow_mass_ += density_ * b.mass_inflow;
  boundary_mass_ += density_ * (b.mass_boundary - b.mass_inflow);
  copied_mass_ += density_ * b.mass_copied;
  w.mass.copied += copied_mass_;
  w.mass.initial += initial_mass_;
  w.mass.continuum = density_ * model_->volume();
  w.mass.left_domain += std::max(0.0, -boundary_mass_) + std::max(0.0, -inflow_mass_);
  w.mass.entered += std::max(0.0, boundary_mass_) + std::max(0.0, inflow_mass_);
  w.momentum.gravity += density_ * b.gravity[0];
  w.momentum.bed += density_ * (b.friction[0] + b.cutoff[0]);
  w.momentum.boundary += density_ * b.boundary[0];
  w.momentum.obstacles += density_ * b.obstacles[0];
  w.momentum.faces += density_ * b.zone[0];
  w.momentum.copied += density_ * b.copied[0];
  const double now = momentum();
  w.momentum.storage += now - momentum_before_;
  momentum_before_ = now;
  if (measures_) w.measures = measures_->read(*model_, w.length);
  model_->reset_budget();
  w.solver_steps = model_->steps();
  w.cell_updates = model_->cell_updates();
  w.min_depth = model_->min_depth();
  w.max_speed = std::max(w.max_speed, model_->max_speed());
}

ObstacleForce FlowSide::force(int id, double window) {
  ObstacleForce out;
  const auto impulse = model_->obstacle_impulse(id);
  for (int q = 0; q < 2; ++q) out.force[q] = density_ * (impulse[q] - impulse_[id][q]) / window;
  impulse_[id] = impulse;
  for (const Cell& c : top_[id]) out.depth_on_top = std::max(out.depth_on_top, model_->at(c.i, c.j).h);
  if (id == planes_obstacle_) {
    out.overflow = overtopped(id);
    out.heap = planes_->heap();
    out.climbed = planes_->climbed(least_climbing_);
  }
  return out;
}

double FlowSide::overtopped(int id) const {
  return id == planes_obstacle_ ? density_ * planes_->overflow() : density_ * model_->gauge(gauge_[id]);
}

FrameView FlowSide::frame() {
  model_->gather(h_, hu_, hv_);
  FrameView view;
  view.h = &h_;
  view.hu = &hu_;
  view.hv = &hv_;
  if (solver_) view.zone = solver_->covered();
  if (planes_) {
    gather_planes();
    view.planes = &plane_views_;
  }
  return view;
}

void FlowSide::gather_planes() {
  constexpr std::pair<PlaneName, const char*> names[] = {{PlaneName::front, "front"},
                                                         {PlaneName::back, "back"},
                                                         {PlaneName::left, "left"},
                                                         {PlaneName::right, "right"},
                                                         {PlaneName::top, "top"}};
  plane_views_.clear();
  for (const auto& [name, word] : names) {
    const PlaneFlow& plane = planes_->plane(name);
    PlaneView view{planes_obstacle_, word, plane.grid(), {}, {}, {}};
    for (int j = 0; j < view.grid.ny; ++j)
      for (int i = 0; i < view.grid.nx; ++i) {
        const FlowState q = plane.at(i, j);
        view.h.push_back(q.h), view.ha.push_back(q.hu), view.hb.push_back(q.hv);
      }
    plane_views_.push_back(std::move(view));
  }
}

}  // namespace couloir
