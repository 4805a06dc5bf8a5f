#pragma once
// The grid cut into blocks, row by row. The mesh knows places and terrain; the solver owns the fields.

#include <utility>
#include <vector>

#include "continuum/mesh/block.hpp"
#include "continuum/mesh/grid.hpp"
#include "continuum/terrain/reference_surface.hpp"
#include "continuum/terrain/step_bed.hpp"

namespace couloir {

struct CellPlace {
  int block = 0, cell = 0;  // number of the block, index in its arrays
};

class Mesh {
 public:
  // edge: cells along a block's edge. curvature: whether the arc's curvature enters.
  // Throws std::invalid_argument where grid, edge or bed do not fit.
  Mesh(const Grid&, int edge, const ReferenceSurface&, const StepBed&, double gravity, bool curvature);

  const Grid& grid() const { return grid_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  std::vector<Block>& blocks() { return blocks_; }
  int blocks_x() const { return blocks_x_; }
  int blocks_y() const { return blocks_y_; }
  CellPlace place(int i, int j) const;  // of the grid cell (i, j)
  // Greatest rate at which slope and bed speed up what lies still, in cells [1/s2]:
  // (g |sin(zeta)| + g cos(zeta) |dz_b/dx|) / dx + g cos(zeta) |dz_b/dy| / dy. Needs the bed in the ghosts.
  double steepest() const;

 private:
  void lay_columns(Block&, const ReferenceSurface&, double gravity, bool curvature);
  void lay_bed(Block&, const StepBed&);
  int pushed_by(int i, int j, const StepBed&) const;  // of a grid cell

  Grid grid_;
  int edge_ = 0, blocks_x_ = 0, blocks_y_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace couloir
