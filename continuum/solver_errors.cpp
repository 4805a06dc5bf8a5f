#include <cmath>
#include <sstream>

#include "continuum/errors.hpp"
#include "continuum/solver_impl.hpp"

namespace couloir {

void Solver::Impl::check_finite() const {
  check_finite_cells(settings.grid, time, steps, "released or handed in", [&](int i, int j) { return get(i, j); });
}

void Solver::Impl::fail_negative(double dt) const {
  int block = 0;
  double least = 0;
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    if (touched[k] && tallies[k].min_depth < least) least = tallies[k].min_depth, block = static_cast<int>(k);
  }
  const Block& b = mesh.blocks()[block];
  std::ostringstream text;
  text << "More material would leave a cell than it holds (depth " << least << " m) between x = " << b.grid.x(b.i0) << " m and "
       << b.grid.x(b.i0 + b.nx - 1) << " m, y = " << b.grid.y(b.j0) << " m and " << b.grid.y(b.j0 + b.ny - 1)
       << " m at t = " << time << " s (step " << steps << "), even with a step of " << dt
       << " s; check what is handed in there, or lower continuum.cfl.";
  throw NumericsError(text.str());
}

void Solver::Impl::fail_step(double dt) const {
  const Grid& g = settings.grid;
  int i = 0, j = 0;
  double fastest = -1;
  for (int n = 0; n < g.ny; ++n) {
    for (int m = 0; m < g.nx; ++m) {
      const FlowState q = get(m, n);
      const double speed = q.h >= settings.dry_depth ? std::hypot(q.hu, q.hv) / q.h + std::sqrt(settings.gravity * q.h) : 0.0;
      if (speed > fastest) fastest = speed, i = m, j = n;
    }
  }
  std::ostringstream text;
  text << "The flow has become so fast that its stable step of " << dt << " s would never end the run, at t = " << time
       << " s (step " << steps << "): " << fastest << " m/s with its waves in cell (" << i << ", " << j << ") at x = " << g.x(i)
       << " m, y = " << g.y(j) << " m; check what was released or handed in there, or use larger cells.";
  throw NumericsError(text.str());
}

}  // namespace couloir
