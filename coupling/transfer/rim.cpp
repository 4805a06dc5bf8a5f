#include "coupling/transfer/rim.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/engine/drive_face.hpp"

namespace couloir {
namespace {

Vec to_vec(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// That the edge of a lateral face from x0 to x1 [m] lies beside; none: it is straight.
const Arc* arc_beside(const ReferenceSurface& surface, double x0, double x1) {
  const Arc* found = nullptr;
  for (const Arc& arc : surface.arcs()) {
    if (x1 <= arc.begin || x0 >= arc.begin + arc.length) continue;
    if (found || arc.curvature < 0)
      throw std::invalid_argument(
          "a face along the slope lies beside a brink, or beside two arcs: its driven layer knows one arc");
    found = &arc;
  }
  return found;
}

Bend bend_of(const ReferenceSurface& surface, const Arc& arc, double x0, double y) {
  return {arc.begin - x0, arc.length, to_vec(surface.to_space({arc.begin, y, 0})),
          to_vec(surface.to_space({arc.begin, y, 1 / arc.curvature}))};
}

}  // namespace

double RimFace::distance(const Vec& p) const {
  return couloir::distance(drive, p);
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
Vec RimFace::direction(double a) const {
  return axis() == 0 ? drive.along : to_vec(surface->tangent(x0 + a));
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

  const auto add = [&](SideName side, int cells, double width, double x0, double y0, const Eigen::Vector3d& inward) {
    RimFace face{.side = side, .cells = cells, .cell_width = width, .drive = {}, .surface = &surface, .x0 = x0, .y0 = y0};
    face.from_anchor = face.axis() == 0 ? yl - (*settings_.anchor)[1] : xl - (*settings_.anchor)[0];
    face.cells_per_segment = std::clamp(int(std::ceil(settings.segment * d / width - 1e-9)), 1, cells);
    face.segments = (cells + face.cells_per_segment - 1) / face.cells_per_segment;
    if (face.axis() == 0)
      face.walls = {settings.walls[2] && zone.j0 == 0, settings.walls[3] && zone.j1 == grid.ny};
    else
      face.walls = {settings.walls[0] && zone.i0 == 0, settings.walls[1] && zone.i1 == grid.nx};
    const auto& open = settings.open;
    face.slides = face.axis() == 0 ? (zone.j0 > 0 || open[2]) && (zone.j1 < grid.ny || open[3])
                                   : (zone.i0 > 0 || open[0]) && (zone.i1 < grid.nx || open[1]);
    const Arc* arc = face.axis() == 0 ? nullptr : arc_beside(surface, x0, x0 + face.extent());
    face.drive = {.origin = to_vec(surface.to_space({x0, y0, 0})),
                  .inward = to_vec(inward),
                  .segment_width = face.cells_per_segment * width,
                  .segments = face.segments,
                  .strip_begin = (settings.buffer - settings.strip) * d,
                  .strip_end = (settings.buffer + settings.strip) * d,
                  .bend = arc ? bend_of(surface, *arc, x0, y0) : Bend{}};
    face.drive.along = face.axis() == 0 ? Vec{0, 1, 0} : to_vec(surface.tangent(arc ? arc->begin : x0));
    faces_.push_back(face);
  };

  const Eigen::Vector3d across(0, 1, 0);
  if (zone.i0 > 0) add(SideName::upstream, zone.j1 - zone.j0, grid.dy, xl, yl, surface.tangent(xl));
  if (zone.i1 < grid.nx) add(SideName::downstream, zone.j1 - zone.j0, grid.dy, xh, yl, -surface.tangent(xh));
  if (zone.j0 > 0) add(SideName::left, zone.i1 - zone.i0, grid.dx, xl, yl, across);
  if (zone.j1 < grid.ny) add(SideName::right, zone.i1 - zone.i0, grid.dx, xl, yh, -across);
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
