#pragma once
// A settled, doubly periodic block of grains on a flat bed: the stock from which flows of grains are cut.

#include <functional>
#include <string>
#include <vector>

#include "coupling/engine/grain_engine.hpp"

namespace couloir {

struct PackingSpec {
  double diameter = 0, spread = 0.1;        // [m], [-]
  double length = 0, width = 0, depth = 0;  // [m] least extent; the block may be a little deeper
  long seed = 20011;
  double friction = 0.5, base_friction = 0.4, rolling_friction = 0.15, base_rolling_friction = 0.15;
  double restitution = 0.5, youngs_modulus = 5e6, poisson_ratio = 0.25;
  double density = 2500;  // [kg/m3] of a grain
  ContactLaw contact = ContactLaw::hertz;
  Rotation rotation = Rotation::free;
  RotationControl control;  // of Rotation::control
  bool tangential_damping = true;
  double timeout = 120;  // [s] of its engine, as EngineSetup's; not of what is settled
};

struct Packing {
  struct Grain {
    double x, y, z, r;  // [m] 0 <= x < length, 0 <= y < width, z above the bed
  };
  double length = 0, width = 0, depth = 0;  // [m] depth: to which the solid fraction below is measured
  double solid_fraction = 0;                // of the bulk, exact sphere-slab volumes between one diameter and depth - 2 d
  std::vector<Grain> grains;                // sorted by x, then id
};

// Settles a block with the engine, or reads it from `cache` (a folder) where a block of exactly this spec is kept. A cache that
// cannot be written costs only time, and is said.
Packing settled_packing(const PackingSpec&, GrainEngine&, const std::string& cache, const std::string& work_dir,
                        const std::function<void(double done)>& progress = {},
                        const std::function<void(const std::string&)>& say = {});

// A surface of nx by ny cells, two triangles each, through these nodes.
std::vector<Triangle> relief(int nx, int ny, const std::function<Vec(int i, int j)>& node);

// A level rectangle from the origin, in triangles of about `size` [m].
std::vector<Triangle> flat_bed(double length, double width, double size);

// Grains, contact law, time step and periodic sides of a block; without gravity, surfaces, the box's top and the grains'
// frictions.
EngineSetup grain_setup(const PackingSpec&, const std::string& work_dir);

}  // namespace couloir
