#include "coupling/loop/flow_side.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/planes/planes_model.hpp"
#include "coupling/loop/costs.hpp"
#include "coupling/loop/flow_models.hpp"
#include "coupling/loop/mode_run.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/release.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {

FlowSide::FlowSide(const Scene& scene, const ReferenceSurface& surface, int threads, const Ranks& ranks)
    : density_(scene.material.density) {
  const StepBed bed = step_bed(scene);
  model_ = flow_model(scene, surface, bed, threads, ranks);
  solver_ = dynamic_cast<Solver*>(model_.get());
  planes_ = dynamic_cast<PlanesModel*>(model_.get());
  planes_obstacle_ = couloir::planes_obstacle(scene);

  lay_bed(bed, solver_ ? solver_settings(scene).refinement.levels() : 0);
  for (std::size_t n = 0; n < scene.obstacles.size(); ++n) {
    tops_.push_back(top_of(scene.obstacles[n], int(n), bed));
    gauge_.push_back(add_gauge(scene.obstacles[n]));
    impulse_.push_back({0, 0});
  }

  if (solver_ && scene.mode == Mode::coupled && !scene.obstacles.empty() && !scene.leaves_out("airborne"))
    make_airborne(scene, surface);
  model_->set([&](double x, double y) { return release_at(scene, x, y); });
  // The cells' sampling of the release is off by its edge; the depth is scaled so that the mass is exact.
  const double wanted = release_volume(scene), sampled = model_->volume();
  if (wanted > 0 && !(sampled > 0)) {
    throw SceneError(scene.places.of("release") +
                     ": the release lies between the centres of the cells, so that the mesh does not see it; use smaller cells");
  }
  if (wanted > 0 && sampled > 0 && scene.release.kind != ReleaseSpec::Kind::uniform) {
    double scale = 1;
    // Again where another depth has made another mesh.
    for (int n = 0; n == 0 || (n < 5 && std::abs(model_->volume() - wanted) > 1e-12 * wanted); ++n) {
      scale *= wanted / model_->volume();
      model_->set([&](double x, double y) {
        FlowState q = release_at(scene, x, y);
        return FlowState{scale * q.h, scale * q.hu, scale * q.hv};
      });
    }
  }
  model_->gather(h_, hu_, hv_);
  least_climbing_ = std::max(1e-6, 0.01 * *std::ranges::max_element(h_));
  initial_mass_ = density_ * model_->volume();
  momentum_before_ = momentum();
}

// As the solver's own cells of the coarsest grid have it: an elevation at their centres, or where blocks may be refined the mean
// of what it is at the centres of the finest; a step stands in the cells whose centres it covers.
void FlowSide::lay_bed(const StepBed& bed, int levels) {
  const Grid &grid = model_->grid(), finest = grid.refined(levels);
  bed_.assign(std::size_t(grid.nx) * grid.ny, 0.0);
  if (!bed.elevation.empty()) bed_ = bed.elevation;
  const int n = 1 << levels;
  for (const StepObstacle& o : bed.obstacles) {
    if (levels == 0 || o.height > 0) continue;
    const CellBox box = centres_in(grid, o.x0 - grid.dx, o.x1 + grid.dx, o.y0 - grid.dy, o.y1 + grid.dy);
    for (int j = std::max(box.j0, 0); j < std::min(box.j1, grid.ny); ++j)
      for (int i = std::max(box.i0, 0); i < std::min(box.i1, grid.nx); ++i) {
        double sum = 0;
        for (int c = 0; c < n * n; ++c) sum += bed.height(finest.x(i * n + c % n), finest.y(j * n + c / n));
        bed_[std::size_t(j) * grid.nx + i] = sum / (n * n);
      }
  }
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      for (const StepObstacle& o : bed.obstacles)
        if (o.height > 0) bed_[std::size_t(j) * grid.nx + i] += o.top(grid.x(i), grid.y(j));
}

void FlowSide::make_airborne(const Scene& scene, const ReferenceSurface& surface) {
  AirborneSettings s;
  s.grid = model_->grid();
  for (int q = 0; q < 4; ++q) {
    const SideSpec& side = scene.sides[q];
    s.sides[q] = side.kind == SideSpec::Kind::periodic ? AirborneSettings::Edge::periodic
                 : side.open()                         ? AirborneSettings::Edge::open
                                                       : AirborneSettings::Edge::wall;
  }
  s.bed = bed_;
  s.gravity = scene.gravity;
  s.bulk_density = density_;
  airborne_ = std::make_unique<Airborne>(s, surface);
}

// The top of a step is its footprint; that of a smooth body are its highest cells: a plateau, or the cells around a peak.
FlowSide::Top FlowSide::top_of(const ObstacleSpec& o, int id, const StepBed& bed) {
  Top top{o.x, o.x + o.length, o.y - o.width / 2, o.y + o.width / 2, {}};
  if (o.method == ObstacleSpec::Method::elevation) {
    top.height = [height = bed.height, owner = bed.owner_at, id](double x, double y) {
      return owner(x, y) == id ? height(x, y) : 0.0;
    };
  } else {
    top.height = [step = bed.obstacles[id]](double x, double y) { return step.top(x, y); };
  }
  return top;
}

double FlowSide::depth_on(const Top& top) const {
  std::vector<std::pair<double, double>> cells;  // height of the body, depth on it
  double highest = 0, depth = 0;
  model_->for_finest(top.x0, top.x1, top.y0, top.y1, [&](const FlowModel::Sample& s) {
    const double height = top.height(s.x, s.y);
    if (height > 0) cells.push_back({height, s.q.h}), highest = std::max(highest, height);
  });
  for (const auto& [height, h] : cells)
    if (height >= 0.99 * highest) depth = std::max(depth, h);
  return depth;
}

// Across the obstacle at its crest: the x-face nearest to it (downstream of two), the rows of its width there.
int FlowSide::add_gauge(const ObstacleSpec& o) {
  const Grid& grid = model_->grid();
  const double half = 0.5 * o.crest_width();
  const int i = int(std::floor((o.crest_x() - grid.x0) / grid.dx + 0.5 + 1e-9));
  int j0 = grid.ny, j1 = 0;
  for (int j = 0; j < grid.ny; ++j)
    if (grid.y(j) >= o.crest_y() - half && grid.y(j) <= o.crest_y() + half) j0 = std::min(j0, j), j1 = j + 1;
  if (j0 >= j1)
    j0 = std::clamp(int(std::floor((o.crest_y() - grid.y0) / grid.dy)), 0, grid.ny - 1), j1 = j0 + 1;  // narrower than a row
  return model_->add_gauge(std::clamp(i, 0, grid.nx), j0, j1);
}

const std::vector<ForceMeasure>& FlowSide::measure(const Scene& scene, const ReferenceSurface& surface,
                                                   const std::vector<CellBox>& zones) {
  measures_.emplace(scene, surface, *model_, zones);
  return measures_->list();
}

void FlowSide::advance_to(double t) {
  const double before = cpu_now();
  const double from = model_->time();
  model_->advance_to(t);
  if (airborne_) {
    const double grounded = cpu_now();
    airborne_->advance(model_->time() - from, *solver_);
    cpu_flights_ += cpu_now() - grounded;
  }
  cpu_ += cpu_now() - before;
}

PartTimes FlowSide::parts() const {
  PartTimes own = model_->part_times();
  const double timed = sum(own), cpu = std::max(0.0, cpu_ - cpu_flights_ - sum(parts_before_));
  for (double& t : own) t *= timed > 0 ? cpu / timed : 0;
  add(own, parts_before_);
  return own;
}

std::vector<PartCost> FlowSide::costs() const {
  std::vector<PartCost> costs = costs_of(parts());
  if (cpu_flights_ > 0) costs.push_back({"flights", "airborne", cpu_flights_});
  return costs;
}

double FlowSide::momentum() const {
  return density_ * model_->momentum()[0] + (airborne_ ? airborne_->momentum() : 0);
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
  if (airborne_) {
    const Airborne::Booked booked = airborne_->collect();
    w.mass.airborne += airborne_->mass();
    w.mass.left_domain += airborne_->left();
    w.momentum.gravity += booked.gravity;
    w.momentum.boundary -= booked.left;
  }
  const double now = momentum();
  w.momentum.storage += now - momentum_before_;
  momentum_before_ = now;
  if (measures_) w.measures = measures_->read(*model_, w.length);
  model_->reset_budget();
  w.solver_steps = model_->steps();
  w.cell_updates = model_->cell_updates();
  w.levels = levels();
  w.min_depth = model_->min_depth();
  w.max_speed = std::max(w.max_speed, model_->max_speed());
}

ObstacleForce FlowSide::force(int id, double window) {
  ObstacleForce out;
  const auto impulse = model_->obstacle_impulse(id);
  for (int q = 0; q < 2; ++q) out.force[q] = density_ * (impulse[q] - impulse_[id][q]) / window;
  impulse_[id] = impulse;
  out.depth_on_top = depth_on(tops_[id]);
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

std::vector<LevelCells> FlowSide::levels() const {
  std::vector<LevelCells> all;
  for (const BlockPlace& b : model_->blocks()) {
    while (static_cast<int>(all.size()) <= b.level) {
      const int level = static_cast<int>(all.size());
      all.push_back({level, model_->grid().refined(level).dx, 0, 0});
    }
    ++all[b.level].blocks;
    all[b.level].cells += std::int64_t{b.nx} * b.ny;
  }
  return all;
}

void FlowSide::gather_blocks() {
  blocks_ = {model_->blocks(), {}, {}, {}};
  std::vector<double> h, hu, hv;
  for (std::size_t k = 0; k < blocks_.places.size(); ++k) {
    model_->gather_block(static_cast<int>(k), h, hu, hv);
    blocks_.h.insert(blocks_.h.end(), h.begin(), h.end());
    blocks_.hu.insert(blocks_.hu.end(), hu.begin(), hu.end());
    blocks_.hv.insert(blocks_.hv.end(), hv.begin(), hv.end());
  }
}

FrameView FlowSide::frame() {
  model_->gather(h_, hu_, hv_);
  gather_blocks();
  FrameView view;
  view.h = &h_;
  view.hu = &hu_;
  view.hv = &hv_;
  if (!blocks_.places.empty()) view.blocks = &blocks_;
  if (planes_) {
    gather_planes();
    view.planes = &plane_views_;
  }
  return view;
}

void FlowSide::state(Archive& a) {
  std::vector<std::uint8_t> model;
  if (!a.loading()) model = model_->checkpoint();
  a(model);
  if (a.loading()) model_->restore(model);
  if (measures_) a(*measures_);
  if (airborne_) a(*airborne_);
  PartTimes so_far = parts();
  a(least_climbing_, impulse_, initial_mass_, boundary_mass_, inflow_mass_, copied_mass_, momentum_before_, cpu_, cpu_flights_,
    so_far);
  if (a.loading()) parts_before_ = so_far;
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
