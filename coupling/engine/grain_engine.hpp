#pragma once
// The port to a discrete-element engine. One engine run = one object = one worker process.
//
//        start(setup)            advance(request) ... advance(request)            stop()
//   idle ------------> running ----------------------------------------> running -------> stopped
//                         | checkpoint(path): state on disk, running goes on with the bits that a restored run has
//   idle --restore(setup, path)--> running
//
// Any call may throw EngineError (dead, silent for longer than the timeout, or the engine's own error); the object is then
// stopped. All vectors are in the engine's Cartesian frame, SI units.

#include <array>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "coupling/engine/contact_law.hpp"
#include "coupling/engine/rotation.hpp"

namespace couloir {

using Vec = std::array<double, 3>;

// [kg] of a sphere; radius [m], density [kg/m3] of the grain.
inline double grain_mass(double radius, double density) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
}

struct Triangle {
  Vec a, b, c;
};

// A rigid surface: a mesh with one friction. Forces are summed over it.
struct EngineSurface {
  std::string name;
  std::vector<Triangle> triangles;
  double friction = 0.5;
  double rolling_friction = 0.15;
};

// Of a face that lies beside an arc: its edge on the bed goes straight, along the arc, and straight on.
struct Bend {
  double begin = 0, length = 0;  // [m] along the face, begin of any sign; length 0: straight
  Vec foot{}, centre{};          // of the arc: where it begins on the bed, a point of its axis, which is along `inward`
};

// A rim face of the zone, through which grains enter in a driven layer and leave.
//
//          exit strip          driven layer |  zone
//   . . . |<- strip ->|<------------------->|            distance along the inward normal from `origin`
//        -strip_end  -strip_begin           0
//
// Grains inserted with segment >= 0 are driven: each segment's grains move as one raft (velocity below) until their centre has
// passed the plane (distance >= 0); then they are free for good. In the strip, free grains move with the given exit velocity
// where the segment's exit is active.
struct DriveFace {
  Vec origin{};              // a point of the plane: low end along `along`
  Vec inward{};              // unit normal, into the zone
  Vec along{};               // unit, along the face; of one that bends: before the bend
  double segment_width = 0;  // [m]
  int segments = 0;
  double strip_begin = 0, strip_end = 0;  // [m] distances outside of the plane, positive
  Bend bend;                              // of its edge on the bed
};

struct EngineSetup {
  double timestep = 0;  // [s]
  Vec gravity{};        // [m/s2]
  Vec lo{}, hi{};       // box [m]; a grain that leaves it is an error unless the axis is periodic
  std::array<bool, 3> periodic{};
  double density = 0;                                                 // [kg/m3] of a grain
  double max_radius = 0;                                              // [m]
  double skin = 0;                                                    // [m] neighbour skin; 0: the engine's choice
  double friction = 0.5, rolling_friction = 0.15, restitution = 0.5;  // between grains
  double youngs_modulus = 5e6, poisson_ratio = 0.25;
  ContactLaw contact = ContactLaw::hertz;  // hertz: Hertz-Mindlin with rolling friction, of the numbers above ...
  LinearContact linear;                    // ... kelvin_voigt: of these and of the Coulomb frictions, without rolling friction
  Rotation rotation = Rotation::free;
  RotationControl control;  // of Rotation::control
  std::vector<EngineSurface> surfaces;
  std::vector<DriveFace> faces;
  int ranks = 1;
  double timeout = 120;            // [s]
  std::string work_dir;            // meshes, logs; must exist
  bool tangential_damping = true;  // false: no damper along contacts, and none pulls; restitution as asked
};

struct NewGrain {
  std::int64_t id = 0;  // unique over the run, > 0, chosen by the caller
  Vec position{}, velocity{};
  double radius = 0;
  int face = -1, segment = -1;  // >= 0: driven by that segment's raft
  Vec spin{};                   // [rad/s] none where it is driven
};

// One raft: the driven grains of one segment, moving as a rigid body:
//   along the inward normal   m du/dt = sum of forces on its grains + push,   least <= u <= most
//   along the face            slide while driven, along when a grain is freed (drive_face.hpp: which way that is)
// With no grains, or with less than `least_mass`, u = most. At an advance's beginning a grain that has slid into another segment
// of its face belongs to that one's raft.
struct SegmentDrive {
  double push = 0;             // [N] by the flow outside
  double most = 0, least = 0;  // [m/s]
  double along = 0;            // [m/s]
  double least_mass = 0;       // [kg]
  bool exit_active = false;
  Vec exit_velocity{};  // [m/s]
  double slide = 0;     // [m/s]
};

// Which raft a grain belongs to from now on.
struct Regrouped {
  std::int64_t id = 0;
  int face = 0, segment = 0;
};

// The rim has moved to these faces. Driven grains that are named belong to the new rafts, which start with their grains' mean
// velocity; all others are free, with the velocity that they would have been freed with.
struct RimMove {
  std::vector<DriveFace> faces;
  std::vector<Regrouped> driven;  // driven or free before; an unknown id is an EngineError
};

struct AdvanceRequest {
  std::int64_t steps = 0;
  std::vector<NewGrain> insert;                   // where they are before the first step; they drift in it like all others
  std::vector<std::int64_t> remove;               // removed before it; an unknown id is an EngineError
  std::vector<std::vector<SegmentDrive>> drives;  // [face][segment]; empty: as before
  bool want_grains = true;                        // send the grains back
  std::vector<RimMove> rim_moves;                 // one at most; before insert, whose faces and segments are the new ones
  std::int64_t sample_steps = 0;                  // > 0: send the forces on surfaces as means over so many steps, too
};

struct SegmentReport {
  double displacement = 0;  // [m] of the raft along the inward normal in this advance
  double velocity = 0;      // [m/s] of the raft at its end
  double force = 0;         // [N] on the raft by its grains' contacts and gravity, mean along the inward normal
  double mass = 0;          // [kg] driven at its end
};

struct Grains {  // sorted by id
  std::vector<std::int64_t> id;
  std::vector<double> x, y, z, vx, vy, vz, radius;  // [m], [m/s], [m]
  std::vector<std::int8_t> driven;                  // 1: in a driven layer
  std::size_t size() const { return id.size(); }
};

// Over an advance of length T, to round-off, with the positions and velocities reported before and after it:
//   change of the grains' momentum = mass after * gravity * T - sum of surface_force * T + drive_impulse
//                                    + momentum of inserted grains as given - of removed grains as last reported
struct Advanced {
  std::int64_t step = 0;  // engine steps since start
  Grains grains;
  std::vector<Vec> surface_force;       // [N] by the grains on each surface, mean over this advance
  std::vector<Vec> surface_force_last;  // [N] at the last step
  std::vector<std::vector<SegmentReport>> segments;
  Vec drive_impulse{};        // [N s] that driving (rafts and strips) gave to the grains, weight and contacts removed
  double kinetic_energy = 0;  // [J] of motion and spin
  double max_overlap = 0;     // [-] largest overlap over mean diameter of the pair, at the last step
  double cpu = 0;             // [s] of all ranks in this advance
  // [N] by all surfaces on the grains inside of all faces (yade: by the parts of surfaces whose middle is there), mean over this
  // advance.
  Vec zone_force{};
  // [N] [surface][n]: mean over the n-th sample_steps steps, weighted as surface_force: where sample_steps divides the steps
  // their mean is surface_force to round-off. Steps left over at the end have none.
  std::vector<std::vector<Vec>> surface_force_samples;
};

class GrainEngine {
 public:
  virtual ~GrainEngine() = default;
  virtual std::string name() const = 0;  // e.g. "LIGGGHTS 3.8.0"; valid after start
  virtual void start(const EngineSetup&) = 0;
  virtual Advanced advance(const AdvanceRequest&) = 0;
  virtual void checkpoint(const std::string& path) = 0;
  virtual void restore(const EngineSetup&, const std::string& path) = 0;
  virtual void stop() = 0;             // never throws
  virtual int worker_pid() const = 0;  // of the worker's first rank; 0 when not running
};

}  // namespace couloir
