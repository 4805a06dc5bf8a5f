#pragma once
// One grid of a nest: its solver, its place on its parent, the rim that the parent gives.

#include <vector>

#include "continuum/noc/nested/layout.hpp"
#include "continuum/noc/noc_solver.hpp"

namespace couloir::noc {

// How many cells in a step reaches: two half steps, each with the slopes of its givers and the earth pressure's differences.
// Even, for whole cells of the parent.
inline int rim_width(Limiter limiter) {
  return limiter == Limiter::eno ? 6 : 4;
}

class Nest {
 public:
  static constexpr int base = 0;

  // parent: null for the base grid.
  Nest(const SolverSettings&, const ReferenceSurface&, const NocBed&, const NocSettings&, const PatchPlace&, const Nest* parent);

  NocSolver solver;
  int level = 0, parent = -1;  // number of the parent among all grids, the base is 0
  std::vector<int> children;
  CellBox inside;      // its cells that are no rim
  CellBox foot;        // what it covers, in cells of the parent
  int i0 = 0, j0 = 0;  // of its cell (0, 0), in cells of this level from the lower corner of the domain

  bool rimmed() const { return !rim_.empty(); }
  void read_start(const Nest& parent);
  void read_end(const Nest& parent);
  void fill_rim(double w);  // w: 0 as at the start of the parent's step, 1 as at its end
  // Mean of the four cells in cell (i, j) of the parent.
  FlowState mean_over(int i, int j) const;
  // The part of a box of the parent's cells that this patch covers, in its own cells and in the parent's.
  CellBox covered(const CellBox& of_parent) const;
  CellBox finer(const CellBox& of_parent) const;

 private:
  struct RimCell {
    int i, j;
    int near_i, far_i, near_j, far_j;  // cells of the parent
    FlowState start, end;
  };
  FlowState from_parent(const RimCell&, const NocSolver& parent) const;
  void lay_rim(const Nest& parent, const std::array<Side, 4>&);

  int shift_i_ = 0, shift_j_ = 0;  // of cell (0, 0), in cells of this level from the parent's cell (0, 0)
  std::vector<RimCell> rim_;
};

}  // namespace couloir::noc
