#include "case.hpp"

#include <algorithm>
#include <cmath>

#include "tests/continuum/scenes.hpp"

namespace couloir::test {

ReferenceSurface Case::surface() const {
  return ReferenceSurface::chute(angle, slope, arc, runout);
}

bool Case::has(Side::Kind kind) const {
  return std::ranges::any_of(settings.sides, [&](const Side& s) { return s.kind == kind; });
}

std::unique_ptr<FlowModel> Case::build(const Subject& subject) const {
  auto solver = subject.make(settings, surface(), bed);
  for (int j = 0; j < grid().ny; ++j) {
    for (int i = 0; i < grid().nx; ++i) solver->set(i, j, start[std::size_t(j) * grid().nx + i]);
  }
  return solver;
}

Case plane(double angle, int nx, int ny, double dx, double dy) {
  Case c;
  c.settings.grid = {nx, ny, dx, dy, 0, -0.5 * ny * dy};
  c.settings.sides = sides(Side::Kind::wall, Side::Kind::wall);
  c.settings.block = 16;
  c.angle = angle;
  c.slope = nx * dx;
  c.start.resize(std::size_t(nx) * ny);
  return c;
}

Case mirrored(const Case& c) {
  Case m = c;
  const int nx = c.grid().nx, ny = c.grid().ny;
  std::swap(m.settings.sides[2], m.settings.sides[3]);
  for (StepObstacle& o : m.bed.obstacles) {
    const double y0 = o.y0;
    o.y0 = -o.y1, o.y1 = -y0;
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const std::size_t to = std::size_t(j) * nx + i, from = std::size_t(ny - 1 - j) * nx + i;
      m.start[to] = {c.start[from].h, c.start[from].hu, -c.start[from].hv};
      if (!c.bed.elevation.empty()) m.bed.elevation[to] = c.bed.elevation[from];
    }
  }
  return m;
}

Case scaled(const Case& c, double factor) {
  Case s = c;
  const double root = std::sqrt(factor);
  for (double* length : {&s.settings.grid.dx, &s.settings.grid.dy, &s.settings.grid.x0, &s.settings.grid.y0,
                         &s.settings.dry_depth, &s.slope, &s.arc, &s.runout}) {
    *length *= factor;
  }
  for (Side& side : s.settings.sides) side.depth *= factor, side.velocity *= root;
  for (double& z : s.bed.elevation) z *= factor;
  for (StepObstacle& o : s.bed.obstacles) {
    for (double* length : {&o.x0, &o.x1, &o.y0, &o.y1, &o.height}) *length *= factor;
  }
  for (FlowState& q : s.start) q.h *= factor, q.hu *= factor * root, q.hv *= factor * root;
  return s;
}

}  // namespace couloir::test
