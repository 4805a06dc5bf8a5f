#include "subject.hpp"

#include <algorithm>
#include <cmath>

#include "continuum/noc/noc_solver.hpp"

namespace couloir::test {
namespace {

// Between the cells' centres, bilinear; level beyond the outermost. Mirrored heights give mirrored bits.
NocBed::Height between_cells(const Grid& g, const std::vector<double>& z) {
  return [=](double x, double y) {
    const auto place = [](double at, int n) {
      const double inside = std::clamp(at, 0.0, n - 1.0);
      const int low = std::min(static_cast<int>(inside), std::max(n - 2, 0));
      return std::pair{low, inside - low};
    };
    const auto [i, a] = place((x - g.x(0)) / g.dx, g.nx);
    const auto [j, b] = place((y - g.y(0)) / g.dy, g.ny);
    const auto row = [&, i = i, a = a](int j) {
      const double* at = &z[static_cast<std::size_t>(j) * g.nx];
      return at[i] * (1 - a) + at[std::min(i + 1, g.nx - 1)] * a;
    };
    return row(j) * (1 - b) + row(std::min(j + 1, g.ny - 1)) * b;
  };
}

std::unique_ptr<FlowModel> make_noc(const SolverSettings& s, const ReferenceSurface& surface, const StepBed& bed) {
  NocBed smooth;
  if (!bed.elevation.empty()) smooth.ground = between_cells(s.grid, bed.elevation);
  for (const StepObstacle& o : bed.obstacles) {
    smooth.obstacles.push_back([body = body_of(o, s.grid)](double x, double y) { return body.at(x, y); });
  }
  return std::make_unique<NocSolver>(s, surface, smooth);
}

}  // namespace

ElevationBody body_of(const StepObstacle& o, const Grid& g) {
  const double ramp = std::min(std::min(g.dx, g.dy), std::min(o.x1 - o.x0, o.y1 - o.y0) / 4);
  return ElevationBody::cuboid(0, o.name, o.x0, o.x1, o.y0, o.y1, o.height, ramp, ramp);
}

std::vector<Subject> subjects() {
  return {{"central_upwind", true, 1e-6,
           [](const SolverSettings& s, const ReferenceSurface& surface, const StepBed& bed) {
             return std::make_unique<Solver>(s, surface, bed);
           }},
          {"noc", false, 1e-4, make_noc}};
}

}  // namespace couloir::test
