#include "coupling/loop/zone_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "coupling/loop/engine_setup.hpp"
#include "coupling/loop/stress_gauges.hpp"
#include "coupling/plan/build.hpp"

namespace couloir {

ZoneSide::ZoneSide(const Scene& scene, const RunOptions& options, const std::string& work_dir, const ReferenceSurface& surface,
                   FlowSide& flow, const PlannedZone& planned, double deepest, Tell tell)
    : scene_(scene),
      options_(options),
      surface_(surface),
      flow_(flow),
      planned_(planned),
      tell_(std::move(tell)),
      work_dir_(work_dir) {
  grains_ = std::make_unique<GrainSide>(scene, options, surface, deepest, [this](const std::string& what) { tell_(0, what); });
  watch_ = std::make_unique<ZoneWatch>(planned.lines, scene.grains.diameter, scene.gravity);
  const CellBox widest = watch_->widest();
  const Grid& grid = flow.solver().grid();
  const bool touches[] = {widest.i0 == 0, widest.i1 == grid.nx, widest.j0 == 0, widest.j1 == grid.ny};
  std::array<bool, 4> open{};
  for (int q = 0; q < 4; ++q) open[q] = touches[q] && scene.sides[q].open();
  // In mode grains what is exchanged passes its upstream face.
  along_ = surface.tangent(scene.mode == Mode::grains ? planned.box.x0 : 0.5 * (planned.box.x0 + planned.box.x1));
  grains_->look_along(along_);
  edge_ = std::make_unique<DomainEdge>(open, scene.terrain.total_length(), scene.terrain.width, grains_->table().grain_density(),
                                       along_);
  gauges_ = stress_gauges(scene, {planned});
}

ZoneSettings ZoneSide::settings() const {
  ZoneSettings s;
  s.box = watch_->box();
  s.rim.diameter = scene_.grains.diameter;
  for (int q = 0; q < 4; ++q) {
    s.rim.walls[q] = scene_.sides[q].kind == SideSpec::Kind::wall;
    s.rim.open[q] = scene_.sides[q].open();
  }
  s.rim.anchor = {planned_.box.x0, planned_.box.y0};
  s.gravity = scene_.gravity;
  s.periodic_y = scene_.sides[2].kind == SideSpec::Kind::periodic && s.box.j0 == 0 && s.box.j1 == flow_.solver().grid().ny;
  s.first_id = next_id_;
  return s;
}

std::unique_ptr<Zone> ZoneSide::new_zone() const {
  return std::make_unique<Zone>(settings(), flow_.solver().grid(), surface_, grains_->table());
}

EngineSetup ZoneSide::setup() const {
  return engine_setup_zone(scene_, surface_, planned_, zone_->rim(), grains_->table().grain_density(), work_dir_);
}

// The flow is near when a cell within reach of the zone is wet: what it covers in two windows, and two cells.
bool ZoneSide::flow_is_near() const {
  Solver& solver = flow_.solver();
  const Grid& grid = solver.grid();
  const double reach = 2 * length_ * solver.max_speed();
  const int mx = 2 + int(reach / grid.dx), my = 2 + int(reach / grid.dy);
  const CellBox b = watch_->box();
  for (int j = std::max(0, b.j0 - my); j < std::min(grid.ny, b.j1 + my); ++j)
    for (int i = std::max(0, b.i0 - mx); i < std::min(grid.nx, b.i1 + mx); ++i)
      if (solver.at(i, j).h > 1e-3 * scene_.grains.diameter) return true;
  return false;
}

void ZoneSide::begin_window(double time, std::int64_t steps, double length) {
  time_ = time, steps_ = steps, length_ = length;
  if (!zone_) {
    if (flow_is_near()) start();
  } else if (!grains_->running()) {
    if (zone_->flow_comes(flow_.solver())) wake();
  } else if (scene_.grains.follow) {
    follow();
  }
  if (!zone_) return;
  zone_->begin_window(steps, length);
  zone_->impose(flow_.solver());
}

void ZoneSide::follow() {
  switch (watch_->calm(*zone_, zone_->flow_comes(flow_.solver()), grains_->last().grains, length_)) {
    case ZoneWatch::Calm::resting:
      return rest();
    case ZoneWatch::Calm::empty:
      if (!flow_is_near()) end();
      return;
    case ZoneWatch::Calm::no:
      break;
  }
  if (const auto wanted = watch_->look(*zone_, flow_.solver(), flow_.solver().grid(), length_)) move(*wanted);
}

// After what the zone holds has changed sides by no force.
void ZoneSide::take_stock() {
  flow_.forget_covered();
  const Grains& g = grains_->last().grains;
  mass_ = zone_->grains_mass(g);
  momentum_ = zone_->grains_momentum(g) + zone_->faces_momentum();
  for (const NewGrain& n : first_.empty() ? zone_->to_insert() : first_) {
    if (!zone_->is_counted(n.id)) continue;
    const double mass = grains_->table().grain_mass(n.radius);
    mass_ += mass;
    momentum_ += mass * along_.dot(Eigen::Vector3d::Map(n.velocity.data()));
  }
}

void ZoneSide::start() {
  zone_ = new_zone();
  const double before = flow_.solver().volume();
  first_ = zone_->take_over(flow_.solver());
  grains_->start(setup(), gauges_);
  take_stock();
  const ZoneBox box = box_of(watch_->box(), flow_.solver().grid());
  tell_(time_, fmt::format("grains start: the flow is within reach of the zone x {:.3f}..{:.3f} m, y {:.3f}..{:.3f} m; {} grains "
                           "replace {:.4g} kg of flow in it",
                           box.x0, box.x1, box.y0, box.y1, first_.size(), (before - flow_.solver().volume()) * flow_.density()));
}

void ZoneSide::move(const ZoneWatch::Move& wanted) {
  watch_->take(wanted);
  auto next = new_zone();
  Solver& solver = flow_.solver();
  const auto moved = next->take_from(*zone_, grains_->last().grains, solver);
  zone_ = std::move(next);
  take_stock();
  const ZoneBox box = box_of(watch_->box(), solver.grid());
  const char* const side = std::array{"upstream", "downstream", "towards low y", "towards high y"}[static_cast<int>(wanted.side)];
  tell_(time_, fmt::format("zone {} {} to x {:.3f}..{:.3f} m, y {:.3f}..{:.3f} m: {}; {:.4g} kg of flow became grains ({} new), "
                           "{:.4g} kg of grains became flow ({} gone), {:.2g} kg owed",
                           wanted.grows ? "grows" : "shrinks", side, box.x0, box.x1, box.y0, box.y1, wanted.reason, moved.covered,
                           moved.filled, moved.opened, moved.freed, moved.left_over));
}

void ZoneSide::rest() {
  grains_->rest();
  zone_->rest(grains_->last().grains, flow_.solver());
  take_stock();
  tell_(time_,
        fmt::format("grains rest: no flow comes in and {} grains, {:.4g} kg, lie still; they are deposit from now on and the "
                    "engine ends",
                    grains_->last().grains.size(), mass_));
}

void ZoneSide::wake() {
  const Grains& g = grains_->last().grains;
  first_.clear();
  for (std::size_t i = 0; i < g.size(); ++i)
    if (!g.driven[i] && !zone_->awaits_removal(g.id[i])) first_.push_back({g.id[i], {g.x[i], g.y[i], g.z[i]}, {}, g.radius[i]});
  zone_->wake();
  grains_->start(setup(), gauges_);
  take_stock();
  tell_(time_,
        fmt::format("grains wake: flow comes in again; the engine starts with the {} grains that lay still", first_.size()));
}

void ZoneSide::end() {
  left_over_ += zone_->faces_mass();
  inserted_ += zone_->inserted();
  returned_ += zone_->returned();
  next_id_ = zone_->next_id();
  zone_->give_up(flow_.solver());
  grains_->rest();
  zone_.reset();
  mass_ = momentum_ = 0;
  flow_.forget_covered();
  tell_(time_,
        fmt::format("grains end: the zone is empty and no flow is near; its cells are the solver's again, {:.2g} kg stay owed",
                    left_over_));
}

void ZoneSide::ask() {
  if (!zone_) return;
  if (!grains_->running()) {
    zone_->count_passed(flow_.solver());
    return grains_->stay(steps_);
  }
  request_ = zone_->request(flow_.solver());
  request_.insert.insert(request_.insert.begin(), first_.begin(), first_.end());
  first_.clear();
}

void ZoneSide::advance() {
  if (engine()) grains_->advance(request_);
}

void ZoneSide::take_back() {
  if (!engine()) return;
  zone_->absorb(grains_->last(), flow_.solver(), flow_.airborne());
  std::vector<std::int64_t> left;
  edge_->take(grains_->last().grains, surface_, left, [&](std::int64_t id) { return zone_->is_counted(id); });
  zone_->take_out(left);
}

void ZoneSide::report(WindowReport& w) {
  w.mass.faces += left_over_;
  w.mass.left_domain += edge_->mass();
  w.inserted += inserted_;
  w.returned += returned_;
  w.engine_steps += grains_->steps();
  if (zone_) {
    const Grains& g = grains_->last().grains;
    const double before = mass_;
    mass_ = zone_->grains_mass(g);
    (grains_->running() ? w.mass.grains : w.mass.continuum) += mass_;
    w.mass.faces += zone_->faces_mass();
    const double momentum = zone_->grains_momentum(g) + zone_->faces_momentum();
    w.momentum.storage += momentum - momentum_;
    w.momentum.gravity += 0.5 * (before + mass_) * scene_.gravity * surface_.gravity_direction().dot(along_) * w.length;
    double sides = 0, obstacles = 0;
    for (const char* side : side_surfaces) sides += grains_->impulse(side);
    for (int k = 0; k < int(scene_.obstacles.size()); ++k) obstacles += grains_->impulse(k);
    w.momentum.boundary += sides - (edge_->momentum() - left_momentum_);
    w.momentum.obstacles += obstacles;
    w.momentum.bed += grains_->zone_impulse() - sides - obstacles;  // what is not of the others
    momentum_ = momentum;
    w.inserted += zone_->inserted();
    w.returned += zone_->returned();
    if (grains_->running()) {
      w.grains += long(g.size());
      w.max_overlap = std::max(w.max_overlap, grains_->last().max_overlap);
      w.max_speed = std::max(w.max_speed, grains_->max_speed());
    }
  }
  left_momentum_ = edge_->momentum();
}

void ZoneSide::state(Archive& a, const std::string& checkpoint) {
  bool begun = zone_ != nullptr, running = grains_->running();
  a(begun, running, *grains_, *edge_, *watch_, first_, next_id_, mass_, momentum_, left_momentum_, left_over_, inserted_,
    returned_);
  if (a.loading() && begun) {
    zone_ = new_zone();
    if (running) {
      grains_->restore(setup(), gauges_, checkpoint);
    } else {
      grains_->rest_again(setup(), gauges_);
    }
  }
  if (begun) a(*zone_);
}

}  // namespace couloir
