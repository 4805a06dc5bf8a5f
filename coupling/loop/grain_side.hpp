#pragma once
// The engine's share of a run: stock, worker, forces by obstacle, counters.

#include <memory>

#include "coupling/checkpoint/archive.hpp"
#include "coupling/loop/energy_guard.hpp"
#include "coupling/loop/engine_setup.hpp"
#include "coupling/loop/observer.hpp"
#include "coupling/loop/run.hpp"
#include "coupling/transfer/overtopping.hpp"
#include "coupling/transfer/packing_table.hpp"

namespace couloir {

class GrainSide {
 public:
  // Settles or fetches the packing for flows up to `depth` [m] deep; `say`: what the user should know of it.
  GrainSide(const Scene&, const RunOptions&, const ReferenceSurface&, double depth,
            const std::function<void(const std::string&)>& say);
  ~GrainSide();

  const PackingTable& table() const { return *table_; }
  double timestep() const { return timestep_; }  // [s]

  void start(const EngineSetup&, const std::vector<StressGauge>&);
  void restore(const EngineSetup&, const std::vector<StressGauge>&, const std::string& checkpoint);
  // The engine ends; its grains, at rest, and their mean forces of late stay as the last ones.
  void rest();
  void stay(std::int64_t steps) { length_ = double(steps) * timestep_; }  // a window at rest
  void rest_again(const EngineSetup&, const std::vector<StressGauge>&);   // after state(): without an engine
  bool running() const { return running_; }
  const Advanced& advance(AdvanceRequest);
  const Advanced& last() const { return last_; }
  std::string engine() const { return engine_name_; }
  GrainEngine& port() { return *engine_; }

  ObstacleForce force(int obstacle) const;  // of the last advance, all its parts; zero where the obstacle has no mesh
  bool has_obstacle(int obstacle) const { return !surfaces_of_obstacle_[obstacle].empty(); }
  double sample_interval() const { return double(sample_steps_) * timestep_; }  // [s]
  std::vector<double> force_samples(int obstacle) const;  // [N] along the slope, of the last advance; WindowReport has them
  std::vector<GaugeStress> stresses() const;              // of the last advance, as the gauges given at the start
  double overtopped(int obstacle) const { return overtopping_[obstacle].mass(); }
  // Adds the last advance's forces on the domain's walls to the measures of kind "wall".
  void add_wall_forces(const std::vector<ForceMeasure>&, std::vector<std::array<double, 2>>& forces) const;
  // The direction that impulses are taken along: the tilted frame's X, or another that the zone's slope has.
  void look_along(const Eigen::Vector3d& unit) { along_ = unit; }
  double impulse(const std::string& surface) const;  // [N s] on the grains in the last advance, by one surface
  double impulse(int obstacle) const;                // likewise, by all parts of an obstacle
  double zone_impulse() const;                       // [N s] likewise, by all surfaces on those of the zone
  double max_speed() const;                          // [m/s]

  std::int64_t steps() const { return steps_before_ + last_.step; }  // of all engines so far
  long peak() const { return peak_; }
  std::int64_t particle_steps() const { return particle_steps_; }
  double cpu() const { return cpu_; }  // [s] of the engine

  // All but the engine's own. Throws CheckpointError where the settled packing is another one than then.
  void state(Archive&);

 private:
  void begin(const EngineSetup&, const std::vector<StressGauge>&);
  void note_start();
  const Scene& scene_;
  const RunOptions& options_;
  const ReferenceSurface& surface_;
  std::unique_ptr<GrainEngine> engine_;
  std::unique_ptr<EnergyGuard> guard_;
  EnergyGuard::State energy_before_;  // of the guard, when the engine starts
  std::unique_ptr<PackingTable> table_;
  EngineSetup setup_;
  std::vector<std::vector<int>> surfaces_of_obstacle_;  // itself and its gauges
  std::vector<StressGauge> gauges_;
  std::vector<int> surface_of_gauge_;
  std::vector<Overtopping> overtopping_;
  Advanced last_;
  std::vector<Vec> mean_force_;  // [N] by surface, then the zone's, of late: windows weigh less by 20 ms
  std::string engine_name_;
  bool running_ = false;
  double timestep_ = 0, cpu_ = 0, length_ = 0;
  long peak_ = 0;
  std::int64_t sample_steps_ = 0;
  Eigen::Vector3d along_ = Eigen::Vector3d::UnitX();
  std::int64_t particle_steps_ = 0, steps_before_ = 0;
};

}  // namespace couloir
