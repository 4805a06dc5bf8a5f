#include "coupling/workers/fix_zone_force.hpp"

#include <algorithm>

#include "coupling/engine/drive_face.hpp"

namespace couloir {

FixZoneForce::FixZoneForce(LAMMPS_NS::LAMMPS* lmp, int n, char** words) : Fix(lmp, n, words) {
  if (n != 4) error->all(FLERR, "fix couloir/zone_force needs before or after");
}

int FixZoneForce::setmask() {
  return LAMMPS_NS::FixConst::POST_FORCE;
}

void FixZoneForce::setup(int) {
  act();
}

void FixZoneForce::post_force(int) {
  act();
  ++steps_;
  for (int k = 0; k < 3; ++k) sum_[k] += now_[k];
}

void FixZoneForce::act() {
  if (faces_->empty()) return;  // the zone is all: what the surfaces' own counts say
  if (!before_) {
    forces_.assign(&atom->f[0][0], &atom->f[0][0] + 3 * std::size_t(atom->nlocal));
    return;
  }
  now_ = {};
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!inside(atom->x[i])) continue;
    const double* const was = &before_->forces_[3 * std::size_t(i)];
    for (int k = 0; k < 3; ++k) now_[k] += atom->f[i][k] - was[k];
  }
}

bool FixZoneForce::inside(const double* x) const {
  return std::ranges::none_of(*faces_, [&](const DriveFace& face) { return distance(face, {x[0], x[1], x[2]}) < 0; });
}

void FixZoneForce::begin_window() {
  first_ = now_;
  sum_ = {};
  steps_ = 0;
}

Vec FixZoneForce::mean() const {
  Vec mean = now_;
  for (int k = 0; k < 3 && steps_ > 0; ++k) mean[k] = (sum_[k] + 0.5 * (first_[k] - now_[k])) / static_cast<double>(steps_);
  return mean;
}

}  // namespace couloir
