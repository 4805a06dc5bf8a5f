#pragma once
// Grains -> fields: depth and momentum of the cells of a box, each grain spread over the four nearest cells (cloud in cell).
// Keeps: mass and momentum of grains whose four cells lie in the box. h = M / (rho_b dx dy), hu = P_x / (rho_b dx dy).

#include <vector>

#include "continuum/solver.hpp"
#include "coupling/checkpoint/archive.hpp"
#include "coupling/engine/grain_engine.hpp"

namespace couloir {

struct CoarseGrained {
  CellBox box;
  std::vector<FlowState> cells;  // [(j - j0) * (i1 - i0) + i - i0]
  void state(Archive& a) { a(box, cells); }
  const FlowState& at(int i, int j) const { return cells[std::size_t(j - box.j0) * (box.i1 - box.i0) + i - box.i0]; }
};

// `periodic_y`: the box spans a periodic width.
CoarseGrained coarse_grain(const Grains&, const Grid&, const CellBox&, const ReferenceSurface&, double grain_density,
                           double bulk_density, bool periodic_y);

}  // namespace couloir
