#pragma once
// A block of cells with two layers of ghosts: its place in the grid, its terrain, its state.
//
//   local (i, j): interior 0 <= i < nx, 0 <= j < ny; ghosts down to -2 and up to nx + 1; rows along x are contiguous.
//   A face has the index of the cell above it: the x-face c lies between cells c - 1 and c, the y-face c between c - row and c.

#include <vector>

#include "continuum/mesh/grid.hpp"

namespace couloir {

// Where cells reach the dry depth: one bit for each side (upstream, downstream, right, left), two cells deep, which is as far as
// the ghosts beside it look, and one for the whole block.
using WetPlaces = unsigned char;
constexpr WetPlaces wet_upstream = 1, wet_downstream = 2, wet_right = 4, wet_left = 8, wet_inside = 16, wet_everywhere = 31;

struct Block {
  static constexpr int ghosts = 2;

  Grid grid;           // of all cells of this size
  int i0 = 0, j0 = 0;  // indices in it of local cell (0, 0)
  int nx = 0, ny = 0;
  int level = 0;  // how often its cells are halved

  int row() const { return nx + 2 * ghosts; }
  int size() const { return row() * (ny + 2 * ghosts); }
  int at(int i, int j) const { return (j + ghosts) * row() + i + ghosts; }
  struct Local {
    int i, j;
  };
  Local local(int cell) const { return {cell % row() - ghosts, cell / row() - ghosts}; }  // at(i, j) is this cell

  WetPlaces places_of(int cell) const {  // of an interior cell, if it is wet
    const auto [i, j] = local(cell);
    const int sides = (i < ghosts ? wet_upstream : 0) | (i >= nx - ghosts ? wet_downstream : 0) | (j < ghosts ? wet_right : 0) |
                      (j >= ny - ghosts ? wet_left : 0);
    return static_cast<WetPlaces>(wet_inside | sides);
  }

  // By cell, ghosts included.
  std::vector<double> bed;    // smooth elevation z_b [m]
  std::vector<double> top;    // height of the step obstacle that fills the cell [m], else 0
  std::vector<int> obstacle;  // its number, else -1
  std::vector<int> pushed;    // interior: obstacle whose elevation is so near that it pushes here; else -1
  bool relief = false;        // some bed of the mesh != 0

  // By column, index i + ghosts.
  std::vector<double> weight;       // g cos(zeta) at cell centres [m/s2]
  std::vector<double> weight_face;  // g cos(zeta) at the x-face below the cell
  std::vector<double> drive;        // g sin(zeta)
  std::vector<double> foot_depth;   // 2 dx tan(zeta) of the cell below the x-face below the cell [m]
  std::vector<double> no_depth;     // 0
  std::vector<double> tan_zeta;
  std::vector<double> kappa;  // curvature [1/m]; 0 where the closure leaves it out
};

// Depth and momenta of a block's cells as separate arrays.
struct Fields {
  std::vector<double> h, hu, hv;
  void resize(int n) { h.resize(n), hu.resize(n), hv.resize(n); }
};

struct BlockState {
  Fields now;                                // ghosts included
  Fields start;                              // at the start of the step; interior only is meaningful
  std::vector<double> passive_x, passive_y;  // share of the passive state, ghosts included; only where K depends on it
  std::vector<double> open;                  // 1: the solver's own cell, 0: covered; ghosts included
  bool all_open = true;                      // no covered cell, ghosts included
  WetPlaces wet = 0;
  WetPlaces was_wet = 0;  // at the start of the step
  bool begun = false;     // took part in the start of this step
  bool stepped = false;   // takes part in its first stage
  bool looked = false;    // its ghosts know the coarser cells beside it

  void back_to_start(const Block& b) {
    for (int j = 0; j < b.ny; ++j) {
      for (int c = b.at(0, j); c < b.at(b.nx, j); ++c) now.h[c] = start.h[c], now.hu[c] = start.hu[c], now.hv[c] = start.hv[c];
    }
  }
};

}  // namespace couloir
