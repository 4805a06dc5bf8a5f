#pragma once
// The force of all surfaces on the grains of the zone: those inside of all its faces. The engine counts forces by mesh, not by
// place; so a fix before the one that adds the surfaces' forces keeps what each grain has, and one behind it takes the
// difference.

#include "coupling/engine/grain_engine.hpp"
#include "coupling/workers/engine_headers.hpp"

namespace couloir {

class FixZoneForce : public LAMMPS_NS::Fix {
 public:
  FixZoneForce(LAMMPS_NS::LAMMPS*, int, char**);  // fix ID all couloir/zone_force before|after
  // before: null for the first of the two. Without faces it counts nothing.
  void watch(FixZoneForce* before, const std::vector<DriveFace>* faces) { before_ = before, faces_ = faces; }
  int setmask() override;
  void setup(int) override;
  void post_force(int) override;

  void begin_window();
  Vec mean() const;  // [N] on this rank's grains; weighted as FixForceProbe's

 private:
  void act();
  bool inside(const double* x) const;
  FixZoneForce* before_ = nullptr;
  const std::vector<DriveFace>* faces_ = nullptr;
  std::vector<double> forces_;
  Vec first_{}, now_{}, sum_{};
  long steps_ = 0;
};

}  // namespace couloir
