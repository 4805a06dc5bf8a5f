#pragma once
// What a run tells those who watch it: records, progress line, tests.
//
//   on_start  (on_event | on_window | on_frame | state, on_checkpoint | state, on_resume)*  on_finish
//
// on_window comes after every coupling window (continuum mode: every recorded interval); on_frame after the window that
// reaches a frame's time. Observers only read.
//
// At a checkpoint state() saves what an observer holds, and has on the disk what it wrote; on_checkpoint(n) says that the
// checkpoint is whole. A run that goes on from one, in a new process or in this one, gives on_start (again) with `resumed`,
// state(), which loads and takes back what was written since, and on_resume.

#include <array>
#include <string>
#include <vector>

#include "continuum/mesh/level_cells.hpp"
#include "continuum/solver.hpp"
#include "coupling/checkpoint/archive.hpp"
#include "coupling/engine/grain_engine.hpp"
#include "coupling/plan/effect.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// A force by another measure than ObstacleForce; the kinds are explained in force_measures.hpp.
struct ForceMeasure {
  std::string of;    // obstacle, or side of the domain
  std::string kind;  // "control_volume" | "elevation" | "elevation_upstream" | "wall"
};

// A part of an obstacle's upstream face on which the grains' stresses are read.
struct StressGauge {
  int obstacle = 0;      // number
  std::string of, name;  // the obstacle, the gauge
  double area = 0;       // [m2]
};

// [Pa] mean over a window, by the grains on a gauge.
struct GaugeStress {
  double normal = 0;  // into the face
  double up = 0;      // shear along the face's height
  double across = 0;  // shear across the slope, to high y
};

struct RunStart {
  const Scene* scene = nullptr;
  const ReferenceSurface* surface = nullptr;
  Grid grid;                // nx = 0 in grains mode
  std::vector<double> bed;  // [m] elevation and step obstacles by cell, [j * nx + i]
  std::vector<std::string> obstacles;
  int planes_obstacle = -1;  // number of the one that is made of planes; -1: none
  std::vector<ForceMeasure> measures;
  std::vector<StressGauge> stress_gauges;  // those that are read
  std::vector<Effect> effects;
  double bulk_density = 0;     // [kg/m3] that both models use
  double window = 0;           // [s] length of a coupling window; continuum mode: of a recorded interval
  double sample_interval = 0;  // [s] of WindowReport::force_samples; 0: there are none
  bool resumed = false;        // from a checkpoint
};

struct MassLedger {  // [kg]
  double initial = 0, continuum = 0, grains = 0, faces = 0, airborne = 0, left_domain = 0, entered = 0;
  double copied = 0;  // by plain copying between refined grids (noc): told apart, so that it hides in no error
  double total() const { return continuum + grains + faces + airborne + left_domain - entered - copied; }
  double relative_error() const;  // |total - initial| / max(initial, entered)
};

struct MomentumLedger {  // [N s] along the slope in this window, tilted frame
  double storage = 0, gravity = 0, bed = 0, obstacles = 0, boundary = 0, faces = 0, copied = 0;
  double residual = 0;  // storage - all the others
  double scale = 0;     // what the residual is divided by: the largest momentum met so far
  // [N s] to all obstacles together in this window: as their own forces have it, and by what the material lost (docs/forces.md).
  double to_obstacles() const { return -obstacles; }
  double lost_to_obstacles() const { return gravity + bed + boundary + copied - storage; }
};

struct ObstacleForce {
  Vec force{};              // [N] mean over the window; x along the slope, y across, z along the normal
  double depth_on_top = 0;  // [m] largest, at the window's end
  // Method planes only; the last two at the window's end.
  double overflow = 0;  // [kg] over the upper edges since the start
  double heap = 0;      // [m] greatest depth on the slope along the foot of its front
  double climbed = 0;   // [m] how high its front is covered by 1 % of the greatest depth at the start
};

struct GaugeReading {
  double depth = 0;                                // [m] of the flow, at the window's end
  double velocity_along = 0, velocity_across = 0;  // [m/s]; 0 where there is no flow
};

struct WindowReport {
  double time = 0;    // [s] at the window's end
  double length = 0;  // [s]
  long index = 0;
  MassLedger mass;
  MomentumLedger momentum;
  std::vector<ObstacleForce> obstacles;         // as RunStart::obstacles
  std::vector<GaugeReading> gauges;             // as the scene's record.gauges; empty in grains mode
  std::vector<std::array<double, 2>> measures;  // [N] mean over the window, (along, across) the slope; as RunStart::measures
  std::vector<GaugeStress> stresses;            // as RunStart::stress_gauges
  // [N] along the slope on each obstacle, means over RunStart::sample_interval one after the other from the window's start;
  // empty where no grains meet it.
  std::vector<std::vector<double>> force_samples;
  long grains = 0, inserted = 0, returned = 0;  // now; since the start
  std::int64_t engine_steps = 0;
  std::int64_t solver_steps = 0, cell_updates = 0;
  std::vector<LevelCells> levels;  // at the window's end; empty: all cells are of one size
  double max_overlap = 0;          // [-]
  double max_speed = 0;            // [m/s] of grains and flow
  double min_depth = 0;            // [m]
  double overtopped = 0;           // [kg] net over all obstacles since the start

  double force_together() const { return momentum.to_obstacles() / length; }                // [N] along the slope
  double force_by_control_volume() const { return momentum.lost_to_obstacles() / length; }  // [N] likewise
  // The obstacle's samples in this window; its mean throughout where it has none.
  std::vector<double> samples_of(std::size_t obstacle, double interval) const;
  void state(Archive& a) {
    a(time, length, index, mass, momentum, obstacles, gauges, measures, stresses, force_samples, grains, inserted, returned,
      engine_steps, solver_steps, cell_updates, levels, max_overlap, max_speed, min_depth, overtopped);
  }
};

// The flow on one plane of an obstacle of method planes: h [m], momenta along the plane's axes [m2/s], [j * nx + i].
struct PlaneView {
  int obstacle = 0;  // number
  std::string name;  // front, back: axes (z, y); left, right: (x, z); top: (x, y)
  Grid grid;
  std::vector<double> h, ha, hb;
};

// Where cells are refined: the blocks, and what they hold, one after the other, each [j * nx + i]. Where blocks lie on one
// another the finest counts.
struct BlocksView {
  std::vector<BlockPlace> places;
  std::vector<double> h, hu, hv;  // [m], [m2/s]
};

struct FrameView {
  double time = 0;
  long index = 0;
  const std::vector<double>*h = nullptr, *hu = nullptr,
        *hv = nullptr;                             // coarsest cells, coarse-grained in the zone; null in grains mode
  std::vector<CellBox> zones;                      // that grains hold now
  const BlocksView* blocks = nullptr;              // null: all cells are of one size
  const std::vector<PlaneView>* planes = nullptr;  // null: none
  const Grains* grains = nullptr;                  // null: none; positions in the tilted frame
};

struct Event {
  double time = 0;
  std::string what;  // one sentence with its reason and its numbers
  void state(Archive& a) { a(time, what); }
};

// Where a broken run has gone on.
struct Resumption {
  double time = 0;  // [s] simulated, of the checkpoint
  std::string reason;
  void state(Archive& a) { a(time, reason); }
};

// [s] of processor time that a part of the run took; effect: that it is there for, empty: none.
struct PartCost {
  std::string part, effect;
  double seconds = 0;
};

struct RunEnd {
  std::string status;  // "done" | "interrupted" | "failed"
  std::string reason;
  double checkpoint = -1;                                      // [s] simulated, of the last one; -1: none
  double wall = 0, cpu = 0;                                    // [s] without what was computed again
  double cpu_continuum = 0, cpu_engine = 0, cpu_coupling = 0;  // [s] shares of cpu
  std::vector<PartCost> costs;                                 // together cpu
  long peak_grains = 0;
  std::int64_t particle_steps = 0;
  std::string engine;  // name and version, empty: none
};

class Observer {
 public:
  virtual ~Observer() = default;
  virtual void on_start(const RunStart&) {}
  virtual void on_window(const WindowReport&) {}
  virtual void on_frame(const FrameView&) {}
  virtual void on_event(const Event&) {}
  virtual void state(Archive&) {}
  virtual void on_checkpoint(std::int64_t) {}
  virtual void on_resume(const Resumption&) {}
  virtual void on_finish(const RunEnd&) {}
};

}  // namespace couloir
