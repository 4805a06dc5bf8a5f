#pragma once
// The uniform grid of cells, and a rectangle of them.

#include <cmath>

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

// The cells, of an endless grid, whose centres lie in the rectangle; along an axis on which none does, those that hold its
// middle.
inline CellBox centres_in(const Grid& g, double x0, double x1, double y0, double y1) {
  const double slack = 1e-9 * (g.dx + g.dy);
  const auto range = [&](double low, double high, double origin, double size, int& begin, int& end) {
    const int first = static_cast<int>(std::ceil((low - slack - origin) / size - 0.5));
    const int last = static_cast<int>(std::floor((high + slack - origin) / size - 0.5));
    begin = first <= last ? first : static_cast<int>(std::floor((0.5 * (low + high) - origin) / size));
    end = first <= last ? last + 1 : begin + 1;
  };
  CellBox box;
  range(x0, x1, g.x0, g.dx, box.i0, box.i1);
  range(y0, y1, g.y0, g.dy, box.j0, box.j1);
  return box;
}

}  // namespace couloir
