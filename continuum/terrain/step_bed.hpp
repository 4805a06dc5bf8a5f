#pragma once
// The bed above the reference surface, by cell: a smooth elevation and solid steps (obstacles).

#include <functional>
#include <string>
#include <vector>

namespace couloir {

// A block that stands on the bed with its axis along the surface normal. One of height 0 is no step: it keeps the number of an
// obstacle that the elevation makes.
struct StepObstacle {
  std::string name;
  double x0, x1, y0, y1;  // [m] footprint in reference coordinates
  double height;          // [m] above the bed
  // Whether a cell with this centre belongs to it. Both edges across the slope count, so that a mirrored scene covers the
  // mirrored cells also where the edges lie on cell centres.
  bool covers(double x, double y) const { return x >= x0 && x < x1 && y >= y0 && y <= y1; }
  // Of a body whose top is not level: its height [m] at a place, 0 where it is not; `height` is the greatest. Empty: level.
  std::function<double(double x, double y)> shape{};
  double top(double x, double y) const { return !covers(x, y) ? 0 : shape ? shape(x, y) : height; }
};

struct StepBed {
  std::vector<double> elevation{};        // z_b at cell centres [m], [j * nx + i]; empty: 0 everywhere
  std::vector<StepObstacle> obstacles{};  // a cell belongs to the obstacle that covers its centre
  std::vector<int> owner{};               // obstacle whose elevation this cell has, -1: none; empty: no obstacle has any
  // For cells of any size, beside the two above: what they were sampled from. Only where cells are refined over an elevation.
  std::function<double(double x, double y)> height{};
  std::function<int(double x, double y)> owner_at{};
};

}  // namespace couloir
