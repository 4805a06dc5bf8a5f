#include "coupling/loop/grain_side.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/checkpoint/checksum.hpp"
#include "coupling/engine/worker_engine.hpp"
#include "coupling/loop/interrupted.hpp"
#include "coupling/loop/stress_gauges.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/stiffness.hpp"

namespace couloir {
namespace {

// Samples of a window: enough for its third harmonic, few enough to keep.
constexpr std::int64_t most_samples = 8;

std::int64_t steps_of_a_sample(std::int64_t window) {
  std::int64_t parts = std::min(most_samples, window);
  while (window % parts != 0) --parts;
  return window / parts;
}

}  // namespace

GrainSide::GrainSide(const Scene& scene, const RunOptions& options, const ReferenceSurface& surface, double depth,
                     const std::function<void(const std::string&)>& say)
    : scene_(scene), options_(options), surface_(surface) {
  // Both engines' flows are cut from the same grains: what differs between two runs is then the engine's.
  WorkerEngine settling(worker_path("liggghts", options.workers));
  const Packing packing = settled_packing(
      packing_spec(scene, depth), settling, options.packings, options.work_dir,
      [&](double) {
        if (options.interrupted()) throw Interrupted();
      },
      say);
  table_ = std::make_unique<PackingTable>(packing, grain_density(scene, packing));
  timestep_ = engine_timestep(scene, table_->grain_density());
  sample_steps_ = steps_of_a_sample(scene.grains.window);
  for (const ObstacleSpec& o : scene.obstacles)
    overtopping_.emplace_back(o.crest_x(), o.crest_y() - 0.5 * o.crest_width(), o.crest_y() + 0.5 * o.crest_width(),
                              table_->grain_density());
}

GrainSide::~GrainSide() {
  if (engine_) engine_->stop();
}

void GrainSide::begin(const EngineSetup& setup, const std::vector<StressGauge>& gauges) {
  setup_ = setup;
  gauges_ = gauges;
  surfaces_of_obstacle_.assign(scene_.obstacles.size(), {});
  surface_of_gauge_.clear();
  const auto number = [&](const std::string& name) {  // the last of that name: an obstacle may be called bed
    int last = -1;
    for (int s = 0; s < int(setup.surfaces.size()); ++s)
      if (setup.surfaces[s].name == name) last = s;
    return last;
  };
  for (int k = 0; k < int(scene_.obstacles.size()); ++k)
    if (const int s = number(scene_.obstacles[k].name); s >= 0) surfaces_of_obstacle_[k].push_back(s);
  for (const StressGauge& g : gauges_) {
    surface_of_gauge_.push_back(number(surface_of(g)));
    surfaces_of_obstacle_[g.obstacle].push_back(surface_of_gauge_.back());
  }
  engine_ = std::make_unique<WorkerEngine>(worker_path(scene_.grains.engine, options_.workers));
}

void GrainSide::start(const EngineSetup& setup, const std::vector<StressGauge>& gauges) {
  begin(setup, gauges);
  steps_before_ += last_.step;
  last_ = {};
  mean_force_.clear();
  engine_->start(setup);
  note_start();
}

void GrainSide::restore(const EngineSetup& setup, const std::vector<StressGauge>& gauges, const std::string& checkpoint) {
  begin(setup, gauges);
  engine_->restore(setup, checkpoint);
  note_start();
}

void GrainSide::rest() {
  engine_->stop();
  engine_.reset();
  guard_.reset();
  energy_before_ = {};
  running_ = false;
  last_.zone_force = mean_force_.back();
  mean_force_.pop_back();
  last_.surface_force = mean_force_;
  last_.max_overlap = 0;
  Grains& g = last_.grains;
  for (auto* v : {&g.vx, &g.vy, &g.vz}) std::fill(v->begin(), v->end(), 0.0);
}

void GrainSide::rest_again(const EngineSetup& setup, const std::vector<StressGauge>& gauges) {
  begin(setup, gauges);
  engine_.reset();
}

void GrainSide::note_start() {
  engine_name_ = engine_->name();
  guard_ = std::make_unique<EnergyGuard>(setup_, stable_timestep(scene_, table_->grain_density()));
  guard_->restore(energy_before_);
  running_ = true;
  options_.on_engine(*engine_);
}

void GrainSide::state(Archive& a) {
  const auto& grains = table_->packing().grains;
  const std::uint64_t present = checksum(grains.data(), grains.size() * sizeof grains[0]);
  std::uint64_t then = present;
  a(then);
  if (then != present) {
    throw CheckpointError(
        "the settled packing that new grains are cut from is not the one that the run began with: the engine settles it "
        "otherwise now; "
        "start the run anew");
  }
  if (guard_) energy_before_ = guard_->state();
  Grains& last = last_.grains;  // by which the guard judges the next advance
  a(last.id, last.x, last.y, last.z, last.vx, last.vy, last.vz, last.radius, last.driven, energy_before_);
  a(last_.step, last_.surface_force, last_.zone_force, mean_force_);
  a(overtopping_, cpu_, peak_, particle_steps_, steps_before_);
}

const Advanced& GrainSide::advance(AdvanceRequest request) {
  request.sample_steps = sample_steps_;
  Advanced now;
  try {
    now = engine_->advance(request);
  } catch (const RunawayError& error) {
    guard_->explain(error);
  }
  guard_->look(request, last_.grains, now);
  last_ = std::move(now);
  length_ = double(request.steps) * timestep_;
  cpu_ += last_.cpu;
  peak_ = std::max(peak_, long(last_.grains.size()));
  particle_steps_ += request.steps * std::int64_t(last_.grains.size());
  for (Overtopping& o : overtopping_) o.look(last_.grains, surface_);
  const double weight = std::min(1.0, length_ / 0.02);
  std::vector<Vec> forces = last_.surface_force;
  forces.push_back(last_.zone_force);
  mean_force_.resize(forces.size(), Vec{});
  for (std::size_t s = 0; s < forces.size(); ++s)
    for (int k = 0; k < 3; ++k) mean_force_[s][k] += weight * (forces[s][k] - mean_force_[s][k]);
  return last_;
}

ObstacleForce GrainSide::force(int k) const {
  ObstacleForce out;
  if (last_.surface_force.empty()) return out;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (const int s : surfaces_of_obstacle_[k]) force += Eigen::Vector3d::Map(last_.surface_force[s].data());
  const double x = scene_.obstacles[k].x;
  out.force = {force.dot(surface_.tangent(x)), force.y(), force.dot(surface_.normal(x))};
  return out;
}

std::vector<double> GrainSide::force_samples(int k) const {
  std::vector<double> out;
  if (!running_ || last_.surface_force_samples.empty()) return out;
  const Eigen::Vector3d along = surface_.tangent(scene_.obstacles[k].x);
  for (const int s : surfaces_of_obstacle_[k]) {
    const std::vector<Vec>& samples = last_.surface_force_samples[s];
    out.resize(samples.size());
    for (std::size_t n = 0; n < samples.size(); ++n) out[n] += Eigen::Vector3d::Map(samples[n].data()).dot(along);
  }
  return out;
}

std::vector<GaugeStress> GrainSide::stresses() const {
  std::vector<GaugeStress> out(gauges_.size());
  if (last_.surface_force.empty()) return out;
  for (std::size_t n = 0; n < gauges_.size(); ++n) {
    const auto force = Eigen::Vector3d::Map(last_.surface_force[surface_of_gauge_[n]].data());
    const ObstacleSpec& o = scene_.obstacles[gauges_[n].obstacle];
    const double middle = o.x + 0.5 * o.length;  // where the cuboid's axis stands on the bed
    out[n] = {force.dot(surface_.tangent(middle)), force.dot(surface_.normal(middle)), force.y()};
    for (double* stress : {&out[n].normal, &out[n].up, &out[n].across}) *stress /= gauges_[n].area;
  }
  return out;
}

void GrainSide::add_wall_forces(const std::vector<ForceMeasure>& measures, std::vector<std::array<double, 2>>& forces) const {
  for (std::size_t k = 0; k < measures.size(); ++k) {
    if (measures[k].kind != "wall") continue;
    for (std::size_t s = 0; s < setup_.surfaces.size() && s < last_.surface_force.size(); ++s) {
      if (setup_.surfaces[s].name != "side_" + measures[k].of) continue;
      const Vec& f = last_.surface_force[s];
      // Along the slope at an end of the domain; on a side wall, which may follow an arc, along the incline at the upper edge.
      const Eigen::Vector3d along = surface_.tangent(measures[k].of == "downstream" ? surface_.length() : 0);
      forces[k][0] += Eigen::Vector3d(f[0], f[1], f[2]).dot(along);
      forces[k][1] += f[1];
    }
  }
}

double GrainSide::impulse(const std::string& surface) const {
  for (std::size_t s = 0; s < setup_.surfaces.size() && s < last_.surface_force.size(); ++s)
    if (setup_.surfaces[s].name == surface) return -Eigen::Vector3d::Map(last_.surface_force[s].data()).dot(along_) * length_;
  return 0;
}

double GrainSide::zone_impulse() const {
  return Eigen::Vector3d::Map(last_.zone_force.data()).dot(along_) * length_;
}

double GrainSide::impulse(int obstacle) const {
  double impulse = 0;
  for (const int s : surfaces_of_obstacle_[obstacle])
    if (!last_.surface_force.empty()) impulse -= Eigen::Vector3d::Map(last_.surface_force[s].data()).dot(along_) * length_;
  return impulse;
}

double GrainSide::max_speed() const {
  const Grains& g = last_.grains;
  double most = 0;
  for (std::size_t i = 0; i < g.size(); ++i) most = std::max(most, g.vx[i] * g.vx[i] + g.vy[i] * g.vy[i] + g.vz[i] * g.vz[i]);
  return std::sqrt(most);
}

}  // namespace couloir
