#pragma once
// What both schemes count and check alike.

#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>

#include "continuum/errors.hpp"
#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/grid.hpp"

namespace couloir {

// What has passed the x-face i of the rows [j0, j1), both of the coarsest cells.
struct Gauge {
  int i, j0, j1;
  double volume;  // [m3]
};

// To and from a checkpoint (bytes.hpp); the members one by one, since there is a gap between them.
template <class Writer>
void put_gauges(Writer& put, const std::vector<Gauge>& gauges) {
  put(static_cast<int>(gauges.size()));
  for (const Gauge& g : gauges) put(std::array{g.i, g.j0, g.j1}), put(g.volume);
}
template <class Reader>
std::vector<Gauge> take_gauges(Reader& in) {
  std::vector<Gauge> gauges(in.template take<int>());
  for (Gauge& g : gauges) {
    const auto [i, j0, j1] = in.template take<std::array<int, 3>>();
    g = {i, j0, j1, in.template take<double>()};
  }
  return gauges;
}

// Throws NumericsError with the first cell whose state, of(i, j), is not finite; `source`: what may have brought it in there.
template <class F>
void check_finite_cells(const Grid& g, double time, std::int64_t steps, const char* source, F&& of) {
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const FlowState q = of(i, j);
      if (std::isfinite(q.h) && std::isfinite(q.hu) && std::isfinite(q.hv)) continue;
      std::ostringstream text;
      text << "The flow is not finite in cell (" << i << ", " << j << ") at x = " << g.x(i) << " m, y = " << g.y(j)
           << " m at t = " << time << " s (step " << steps << "): h = " << q.h << " m, hu = " << q.hu << " m2/s, hv = " << q.hv
           << " m2/s; check what was " << source << " there, or lower continuum.cfl.";
      throw NumericsError(text.str());
    }
  }
}

}  // namespace couloir
