#pragma once
// Depth and velocity of the flow at a point, or where it is deepest in a rectangle.

#include "continuum/flow_model.hpp"
#include "coupling/loop/observer.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

// A point: bilinear between the four nearest cell centres (depth and momentum; the velocity is their ratio); beyond the last
// centres as on them. A rectangle: the deepest cell whose centre is in it. On refined grids: of the finest. In a zone the cells
// hold what the grains are on the mean. Up to the depth thin [m] the velocity is 0.
GaugeReading read_gauge(const FlowModel&, const GaugeSpec&, double thin);

}  // namespace couloir
