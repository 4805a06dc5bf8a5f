#pragma once
// From a cell to its four children and back. Both keep volume and momentum; linear fields are exact.
//
//   +---+---+      children in the order (-,-), (+,-), (-,+), (+,+); their centres lie a quarter of the cell off its own
//   | 2 | 3 |
//   +---o---+      The surface h + z_b is drawn where the cell and its neighbours are wet, so that a lake stays level; the depth
//   | 0 | 1 |      elsewhere. Slopes by minmod: no child is deeper or shallower than its surroundings, none is faster.
//   +---+---+

#include <array>

#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/block.hpp"

namespace couloir {

// What the children of a cell differ by, a quarter of the limited difference to the next cell along x and y.
struct CellSlopes {
  double hx = 0, hy = 0, hux = 0, huy = 0, hvx = 0, hvy = 0;
  double fastest_u = 0, fastest_v = 0;  // [m/s] of the cell and its neighbours
  bool surface = false;                 // hx, hy are those of h + z_b
};

// Of a block's cell that has neighbours in its arrays; a film has none, whatever lies beside it. dry_depth [m].
CellSlopes slopes_of(const Fields&, const Block&, int cell, double dry_depth);

// Likewise of the bed alone.
std::array<double, 2> bed_slopes_of(const Block&, int cell);

// The children of a cell with this state and bed z_b; bed: theirs, whose mean is z_b.
std::array<FlowState, 4> children_of(const FlowState&, double z_b, const CellSlopes&, const std::array<double, 4>& bed);

// The cell whose lower left child is this one; row: of the children's block.
FlowState parent_of(const Fields&, int row, int child);

// The mean of four children of one quantity; four times the same gives the same bits.
inline double mean_of_children(const double* q, int child, int row) {
  return 0.25 * ((q[child] + q[child + 1]) + (q[child + row] + q[child + row + 1]));
}

}  // namespace couloir
