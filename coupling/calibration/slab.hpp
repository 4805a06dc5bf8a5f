#pragma once
// The virtual experiment: a slab of grains, periodic along and across, slides down an incline.
//
//        gravity, tilted by the slope            mu = tan(slope) - a / (g cos(slope))
//    o o o o o o o o   -> u(t)
//    o o o o o o o o                             a = du/dt of its mean velocity: what the base holds back, over the weight
//   -----------------  flat base: delta;   /\_/\/\_  rough base: the slab shears within: phi
//
// Only fixed triangles, gravity and a periodic box: all that the port (grain_engine.hpp) has.

#include <functional>
#include <string>
#include <vector>

#include "coupling/engine/grain_engine.hpp"
#include "coupling/engine/packing.hpp"

namespace couloir {

constexpr double slab_gravity = 9.81;  // [m/s2]

enum class SlabBase { flat, rough };

struct SlabSpec {
  // The settled block that is cut; its frictions are those that it settles with, not those it slides with.
  PackingSpec stock;
  SlabBase base = SlabBase::flat;
  double depth = 0;                                         // [m] of the slab; at most the stock's
  double friction = 0.5, rolling_friction = 0.1;            // between grains; a rough base has friction 1 and theirs of rolling
  double base_friction = 0.4, base_rolling_friction = 0.1;  // of a flat base
  double slope = 0;                                         // [rad]
  double speed = 0;                                         // [m/s] at the start; on a rough base the mean of a sheared slab
  double settling = 0;                                      // [s] that are not measured
  double duration = 0;                                      // [s] that are measured; on a rough base at most, until it rests
  double window = 0;                                        // [s] between points of the curve
};

// Means over one window.
struct SlabPoint {
  double time = 0;      // [s] its middle
  double speed = 0;     // [m/s] of the slab's centre of mass
  double friction = 0;  // [-] mu
  double inertia = 0;   // [-] I = 5 u d / (2 h sqrt(c g h cos(slope))), c the solid fraction: the depth's mean for a slab that
                        // shears as Bagnold's profile does (GDR MiDi, Eur. Phys. J. E 14, 2004, 341)
  double slip = 0;      // [-] speed of the lowest layer of one diameter over the slab's
};

struct SlabCurve {
  std::string engine;  // name and version
  std::size_t grains = 0;
  double solid_fraction = 0;  // of the stock
  std::vector<SlabPoint> points;
};

// Settles the stock (or reads it from `cache`), lays the slab on its base and lets it slide. `stop` is asked between windows:
// true ends with Stopped (coupling/cases/share_out.hpp). Throws EngineError.
SlabCurve slide(
    const SlabSpec&, GrainEngine&, const std::string& cache, const std::string& work_dir,
    const std::function<bool()>& stop = [] { return false; });

// One line that says all of a spec, exactly: two specs with the same are the same measurement.
std::string describe(const SlabSpec&);

// Heights at random between 0 and a diameter, one node a diameter, periodic: a base that grains cannot slide or roll on in rows.
std::vector<Triangle> rough_base(double length, double width, double diameter);

}  // namespace couloir
