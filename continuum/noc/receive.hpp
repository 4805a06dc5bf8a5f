#pragma once
// The corrector (3.12) in inner loops: a row of points gathers four parts each, then friction. For points away from the domain's
// sides, and on periodic ones; assembly.cpp has the others.

#include <limits>
#include <vector>

#include "continuum/noc/lattice.hpp"
#include "continuum/noc/share.hpp"
#include "continuum/scheme/budget.hpp"

namespace couloir::noc {

// Of some rows, per area of a cell.
struct RowSums {
  Budget budget;
  double min_depth = std::numeric_limits<double>::infinity();
  bool finite = true;
  void note(double h, double hu, double hv) {
    const double all = h + hu + hv;
    min_depth = smaller(min_depth, h);
    finite = finite && all - all == 0;
  }
};

// Sums by column over some rows: so they vectorise, and their order is fixed.
class ColumnSums {
 public:
  void clear(int nx);
  void add_to(RowSums&) const;

  enum Column { gravity_x, gravity_y, friction_x, friction_y, cutoff_x, cutoff_y, not_finite, least, count };
  double* at(Column c) { return columns_[c].data(); }

 private:
  std::vector<double> columns_[count];
};

// Row j of the corners from the centres, or of the centres from the corners; points i0 <= i < i1.
void receive_at_corners(Lattice& corners, const Lattice& centres, const Terrain&, const Drag&, int j, int i0, int i1, double tau,
                        ColumnSums&);
void receive_at_centres(Lattice& centres, const Lattice& corners, const Terrain&, const Drag&, int j, int i0, int i1, double tau,
                        ColumnSums&);

// The least depth that these points would get.
double least_at_corners(const Lattice& centres, int j, int i0, int i1);
double least_at_centres(const Lattice& centres, const Lattice& corners, int j, int i0, int i1);

// Depth that a corner gives back to a cell by its quadrant (cx, cy); a locked one gives what it got.
[[gnu::always_inline]] inline double share_back(const Point& corner, const Point& centre, double locked, double cx, double cy) {
  const double got = share_depth(centre, -cx, -cy), given = share_depth(corner, cx, cy);  // both: no branch in inner loops
  return locked > 0 ? got : given;
}

}  // namespace couloir::noc
