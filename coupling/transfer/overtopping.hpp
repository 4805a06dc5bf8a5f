#pragma once
// How much grain mass passes over an obstacle: centres that cross the plane through its middle, within its width, net downslope.

#include <vector>

#include "continuum/terrain/reference_surface.hpp"
#include "coupling/checkpoint/archive.hpp"
#include "coupling/engine/grain_engine.hpp"

namespace couloir {

class Overtopping {
 public:
  // middle: x of the obstacle's middle; y0, y1: its sides [m].
  Overtopping(double middle, double y0, double y1, double grain_density)
      : middle_(middle), y0_(y0), y1_(y1), density_(grain_density) {}

  void look(const Grains&, const ReferenceSurface&);
  double mass() const { return mass_; }  // [kg] since the start
  void state(Archive& a) { a(mass_, side_); }

 private:
  double middle_, y0_, y1_, density_, mass_ = 0;
  std::vector<signed char> side_;  // by id: -1 upstream, +1 downstream, 0 not yet seen
};

}  // namespace couloir
