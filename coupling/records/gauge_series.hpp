#pragma once
// What a gauge's history is reduced to.

#include <algorithm>
#include <cmath>

#include "coupling/loop/observer.hpp"

namespace couloir {

class GaugeSeries {
 public:
  // The flow has arrived where it is `arrival_depth` [m] deep (scene/depths.hpp).
  explicit GaugeSeries(double arrival_depth) : arrival_depth_(arrival_depth) {}

  // `time` at the window's end and its `length` [s]; the reading stands for the window.
  void add(double time, double length, const GaugeReading& g) {
    if (arrival < 0 && g.depth > 0 && g.depth >= arrival_depth_) arrival = time;
    if (g.depth > max_depth) max_depth = g.depth, max_depth_time = time;
    depth_final = g.depth;
    if (arrival < 0) return;
    max_speed = std::max(max_speed, std::hypot(g.velocity_along, g.velocity_across));
    span_ += length, depth_ += g.depth * length, flux_ += g.depth * g.velocity_along * length;
  }

  double max_depth = 0, max_depth_time = 0;  // [m], [s]
  double depth_final = 0;                    // [m] at the end
  double arrival = -1;                       // [s] end of the first window with that depth or more; -1: never
  double max_speed = 0;                      // [m/s] since the arrival: the film before it has no speed worth showing
  // Means since the arrival; 0 without one.
  double depth_mean() const { return span_ > 0 ? depth_ / span_ : 0; }      // [m]
  double velocity_mean() const { return depth_ > 0 ? flux_ / depth_ : 0; }  // [m/s] along the slope, of the passing material

 private:
  double arrival_depth_, span_ = 0, depth_ = 0, flux_ = 0;
};

}  // namespace couloir
