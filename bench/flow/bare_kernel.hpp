#pragma once
// A bare kernel of the same scheme, to compare with: shallow water on a level bed, two stages of Heun, MUSCL with minmod, HLL, in
// blocks of 32 x 32 cells with two ghosts, periodic. No terrain, friction, earth pressure, rest, dry cells, sides, sums.

#include <functional>
#include <vector>

#include "continuum/flow/flow_state.hpp"
#include "continuum/scheme/values.hpp"

namespace couloir::bench {

struct BareBlock {
  static constexpr int edge = 32, row = edge + 2 * Block::ghosts, size = row * row;
  static constexpr int at(int i, int j) { return (j + Block::ghosts) * row + i + Block::ghosts; }
  Values h, hu, hv, h0, hu0, hv0;
};

struct BareScratch {
  Values u, v, h_lo, h_hi, un_lo, un_hi, ut_lo, ut_hi;
  Values mass[2], normal[2], tangent[2];
  Values fastest;  // by column
};

// Compiled once for each instruction set (bare_kernel.cpp).
struct BareKernel {
  // One stage on one block with ghosts; courant: dt / dx. Returns the greatest |u| + |v| + 2c that it leaves.
  double (*stage)(BareBlock&, BareScratch&, bool corrector, double courant, double g);
};

// The kernel of chosen_isa() on nx x ny cells of size 1, both multiples of 32.
class BareFlow {
 public:
  BareFlow(int nx, int ny, double g);
  void set(const std::function<FlowState(int i, int j)>&);
  void step();  // at CFL number 0.45
  long cell_updates() const { return updates_; }

 private:
  void fill_ghosts();
  int blocks_x_, blocks_y_;
  double g_, fastest_ = 0;
  long updates_ = 0;
  std::vector<BareBlock> blocks_;
  BareScratch scratch_;
  const BareKernel* kernel_;
};

}  // namespace couloir::bench
