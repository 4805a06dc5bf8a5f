#pragma once
// The blocks of a grid, of one size of cells or of several: a leaf of the forest is a block, with as many cells at each level.
// The mesh knows places and terrain; the solver owns the fields.

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "continuum/mesh/block.hpp"
#include "continuum/mesh/forest.hpp"
#include "continuum/mesh/grid.hpp"
#include "continuum/terrain/reference_surface.hpp"
#include "continuum/terrain/step_bed.hpp"

namespace couloir {

struct CellPlace {
  int block = 0, cell = 0;  // number of the block, index in its arrays
};

class Mesh {
 public:
  // edge: cells along a block's edge. curvature: whether the arc's curvature enters. levels: how deep become() may refine; then
  // edge must be even. Blocks of the coarsest cells, row by row.
  // Throws std::invalid_argument where grid, edge, levels or bed do not fit.
  Mesh(const Grid&, int edge, const ReferenceSurface&, const StepBed&, double gravity, bool curvature, int levels = 0);

  const Grid& grid() const { return grid_; }  // of the coarsest cells
  int levels() const { return levels_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  std::vector<Block>& blocks() { return blocks_; }
  const std::vector<Leaf>& leaves() const { return leaves_; }  // of the blocks, one each
  int blocks_x() const { return blocks_x_; }                   // of the coarsest grid
  int blocks_y() const { return blocks_y_; }

  // The blocks of these leaves from now on; those that stay keep their terrain, but all ghosts are to be laid again. Leaves
  // without a cell of the domain are left out.
  void become(const std::vector<Leaf>&);

  // The block with this cell of its own level, and at the level above or below where there is none: then cell is -1.
  struct Found {
    int block, level, cell;
  };
  Found find(int level, int i, int j) const;
  int block_of(const Leaf&) const;  // -1: there is none
  // The rectangle of the block's cells over the coarsest cell (i, j).
  struct Patch {
    int block, i, j, n;  // local [i, i + n) x [j, j + n)
  };
  Patch over(int i, int j) const;

  // Greatest rate at which slope and bed speed up what lies still, in cells [1/s2]:
  // (g |sin(zeta)| + g cos(zeta) |dz_b/dx|) / dx + g cos(zeta) |dz_b/dy| / dy. Needs the bed in the ghosts.
  // At a finer level it counts less by the square of the steps there.
  double steepest() const;

  // Top and number of the step obstacle at a place, 0 and -1 where there is none.
  std::pair<double, int> step_at(double x, double y) const;

 private:
  Block make(const Leaf&) const;
  void lay_columns(Block&) const;
  void lay_bed(Block&) const;
  double elevation(const Block&, int i, int j) const;  // of a cell of the block's grid
  int pushed_by(const Block&, int i, int j) const;     // of a cell of the block's grid
  int owner_in(int level, int i, int j) const;         // obstacle whose elevation some of the finest cells in this one have
  void index();

  Grid grid_;
  int edge_ = 0, levels_ = 0, blocks_x_ = 0, blocks_y_ = 0;
  ReferenceSurface surface_;
  StepBed bed_;
  double gravity_ = 0;
  bool curvature_ = false;
  std::vector<Leaf> leaves_;
  std::vector<Block> blocks_;
  std::vector<std::vector<int>> number_;              // of the block, by level and place; -1: none
  mutable std::map<std::array<int, 3>, int> owners_;  // owner_in() by level, i, j, which is asked for again and again
};

}  // namespace couloir
