#pragma once
// The uniform grid of cells, and a rectangle of them.

namespace couloir {

struct Grid {
  int nx = 0, ny = 0;     // cells
  double dx = 0, dy = 0;  // [m]
  double x0 = 0, y0 = 0;  // lower corner of cell (0, 0) [m]
  double x(int i) const { return x0 + (i + 0.5) * dx; }
  double y(int j) const { return y0 + (j + 0.5) * dy; }
  // The same domain with each cell halved so many times.
  Grid refined(int levels) const {
    const double parts = 1 << levels;
    return {nx << levels, ny << levels, dx / parts, dy / parts, x0, y0};
  }
};

struct CellBox {
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;  // [i0, i1) x [j0, j1)
  bool contains(int i, int j) const { return i >= i0 && i < i1 && j >= j0 && j < j1; }
  bool empty() const { return i1 <= i0 || j1 <= j0; }
};

}  // namespace couloir
