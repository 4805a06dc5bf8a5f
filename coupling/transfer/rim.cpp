#include "coupling/transfer/rim.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {
namespace {

Vec to_vec(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

double dot_offset(const Vec& p, const Vec& origin, const Vec& direction) {
  return (p[0] - origin[0]) * direction[0] + (p[1] - origin[1]) * direction[1] + (p[2] - origin[2]) * direction[2];
}

}  // namespace

double RimFace::distance(const Vec& p) const {
  return dot_offset(p, drive.origin, drive.inward);
}
// A lateral face follows the surface: across an arc the chord is shorter, and a grain's height above the bed would count.
double RimFace::along(const Vec& p) const {
  return axis() == 0 ? p[1] - y0 : surface->to_surface({p[0], p[1], p[2]}).x - x0;
}
Vec RimFace::place(double distance, double along, double height) const {
  const double in = sign() * distance;
  return to_vec(axis() == 0 ? surface->to_space({x0 + in, y0 + along, height})
                            : surface->to_space({x0 + along, y0 + in, height}));
}
int RimFace::cell_at(double a) const {
  return int(std::clamp(std::floor(a / cell_width), 0.0, double(cells - 1)));
}

Rim::Rim(const Grid& grid, const CellBox& zone, const ReferenceSurface& surface, const RimSettings& settings)
    : zone_(zone), settings_(settings) {
  const double xl = grid.x0 + zone.i0 * grid.dx, xh = grid.x0 + zone.i1 * grid.dx;
  const double yl = grid.y0 + zone.j0 * grid.dy, yh = grid.y0 + zone.j1 * grid.dy;
  const double d = settings.diameter;
  if (!settings_.anchor) settings_.anchor = {xl, yl};

  const Eigen::Vector3d low = surface.to_space({xl, 0, 0});
  // The engine's segments of a lateral face lie along the chord.
  const Eigen::Vector3d chord = (surface.to_space({xh, 0, 0}) - low).normalized();
  double sagitta = 0;
  for (int i = zone.i0; i < zone.i1; ++i) {
    const Eigen::Vector3d p = surface.to_space({grid.x0 + i * grid.dx, 0, 0}) - low;
    sagitta = std::max(sagitta, (p - p.dot(chord) * chord).norm());
  }

  const auto add = [&](SideName side, int cells, double width, double x0, double y0, const Eigen::Vector3d& inward,
                       const Eigen::Vector3d& along) {
    RimFace face{.side = side, .cells = cells, .cell_width = width, .drive = {}, .surface = &surface, .x0 = x0, .y0 = y0};
    face.from_anchor = face.axis() == 0 ? yl - (*settings_.anchor)[1] : xl - (*settings_.anchor)[0];
    face.cells_per_segment = std::clamp(int(std::ceil(settings.segment * d / width - 1e-9)), 1, cells);
    face.segments = (cells + face.cells_per_segment - 1) / face.cells_per_segment;
    if (face.axis() == 0)
      face.walls = {settings.walls[2] && zone.j0 == 0, settings.walls[3] && zone.j1 == grid.ny};
    else
      face.walls = {settings.walls[0] && zone.i0 == 0, settings.walls[1] && zone.i1 == grid.nx};
    // Beside an arc a layer would leave the bed: it moves straight.
    face.slides = face.axis() == 0 ? zone.j0 > 0 && zone.j1 < grid.ny : zone.i0 > 0 && zone.i1 < grid.nx && sagitta < 0.1 * d;
    face.drive = {.origin = to_vec(surface.to_space({x0, y0, 0})),
                  .inward = to_vec(inward),
                  .along = to_vec(along),
                  .segment_width = face.cells_per_segment * width,
                  .segments = face.segments,
                  .strip_begin = (settings.buffer - settings.strip) * d,
                  .strip_end = (settings.buffer + settings.strip) * d};
    faces_.push_back(face);
  };

  const Eigen::Vector3d across(0, 1, 0);
  if (zone.i0 > 0) add(SideName::upstream, zone.j1 - zone.j0, grid.dy, xl, yl, surface.tangent(xl), across);
  if (zone.i1 < grid.nx) add(SideName::downstream, zone.j1 - zone.j0, grid.dy, xh, yl, -surface.tangent(xh), across);
  if (zone.j0 > 0) add(SideName::left, zone.i1 - zone.i0, grid.dx, xl, yl, across, chord);
  if (zone.j1 < grid.ny) add(SideName::right, zone.i1 - zone.i0, grid.dx, xl, yh, -across, chord);
}

std::pair<int, int> Rim::outside_cell(const RimFace& face, int k) const {
  switch (face.side) {
    case SideName::upstream:
      return {zone_.i0 - 1, zone_.j0 + k};
    case SideName::downstream:
      return {zone_.i1, zone_.j0 + k};
    case SideName::left:
      return {zone_.i0 + k, zone_.j0 - 1};
    default:
      return {zone_.i0 + k, zone_.j1};
  }
}

std::pair<int, int> Rim::inside_cell(const RimFace& face, int k) const {
  switch (face.side) {
    case SideName::upstream:
      return {zone_.i0, zone_.j0 + k};
    case SideName::downstream:
      return {zone_.i1 - 1, zone_.j0 + k};
    case SideName::left:
      return {zone_.i0 + k, zone_.j0};
    default:
      return {zone_.i0 + k, zone_.j1 - 1};
  }
}

}  // namespace couloir
