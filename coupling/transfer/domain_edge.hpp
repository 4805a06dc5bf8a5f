#pragma once
// Grains that leave the domain through an open side: taken out, and their mass and momentum booked.

#include <array>
#include <functional>
#include <vector>

#include "continuum/terrain/reference_surface.hpp"
#include "coupling/checkpoint/archive.hpp"
#include "coupling/engine/grain_engine.hpp"

namespace couloir {

class DomainEdge {
 public:
  // open[side]: upstream, downstream, left, right. length, width [m]. along: unit, the direction of the momentum.
  DomainEdge(std::array<bool, 4> open, double length, double width, double grain_density,
             const Eigen::Vector3d& along = Eigen::Vector3d::UnitX())
      : open_(open), length_(length), width_(width), density_(grain_density), along_(along) {}

  // Appends the ids of those outside; books those of which `counted` says that they are the run's. The others, which only stood
  // by, would go on falling until they left the engine's box.
  void take(
      const Grains&, const ReferenceSurface&, std::vector<std::int64_t>& remove,
      const std::function<bool(std::int64_t)>& counted = [](std::int64_t) { return true; });
  double mass() const { return mass_; }          // [kg] since the start
  double momentum() const { return momentum_; }  // [N s] since the start
  void state(Archive& a) { a(mass_, momentum_); }

 private:
  std::array<bool, 4> open_;
  double length_, width_, density_, mass_ = 0, momentum_ = 0;
  Eigen::Vector3d along_;
};

}  // namespace couloir
