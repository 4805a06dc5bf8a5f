#pragma once
// Blocked rotation and rotation control (coupling/engine/rotation.hpp), every step, after all contacts.
//
//   w += dt/2 M / I,  x += dt v,  M = contacts     the step's first half
//   slides   w = M = 0: neither half kick does anything, so a grain that slides has no spin at all, and that tells that it does
//   rolls    w <- k^(dt / lambda) w
//   w += dt/2 M / I                                its second half

#include <vector>

#include "coupling/engine/grain_engine.hpp"
#include "coupling/workers/engine_headers.hpp"

// clang-format off
#include <liggghts/fix_mesh_surface.h>
// clang-format on

namespace couloir {

class FixRotation : public LAMMPS_NS::Fix {
 public:
  FixRotation(LAMMPS_NS::LAMMPS*, int, char**);
  void set(const EngineSetup&, std::vector<LAMMPS_NS::FixMeshSurface*> surfaces);
  int setmask() override;
  void setup(int) override;
  void post_force(int) override;

 private:
  void hold(int i);
  void hold_those_that_slide();
  void count_grains();
  void count_surfaces(LAMMPS_NS::FixMeshSurface&);
  double shear(int i) const { return shear_[i] / contacts_[i]; }

  Rotation rule_ = Rotation::free;
  RotationControl control_;
  std::vector<LAMMPS_NS::FixMeshSurface*> surfaces_;
  std::vector<int> contacts_;  // by local grain
  std::vector<double> shear_;  // [m/s] summed over its contacts
};

}  // namespace couloir
