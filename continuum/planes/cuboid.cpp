#include "continuum/planes/cuboid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace couloir {
namespace {

constexpr const char* names[] = {"front plane", "back plane", "left plane", "right plane", "top plane"};

}  // namespace

PlaneSettings plane_settings(PlaneName plane, const CuboidCells& cells, double gravity, double zeta,
                             const PlaneSettings& common) {
  const int n[] = {cells.nx, cells.ny, cells.nz};
  const double size[] = {cells.dx, cells.dy, cells.dz};
  const double along[] = {gravity * std::sin(zeta), 0, -gravity * std::cos(zeta)};
  const PlaneAxes axes = axes_of(plane);
  PlaneSettings s = common;
  s.name = names[static_cast<int>(plane)];
  // From the middle across, as the slope's own grid.
  s.grid = {n[axes.a], n[axes.b], size[axes.a], size[axes.b], 0, axes.b == 1 ? -0.5 * n[1] * size[1] : 0.0};
  s.drive_a = along[axes.a], s.drive_b = along[axes.b];
  s.weight = plane == PlaneName::front ? std::max(0.0, along[0]) : plane == PlaneName::top ? std::max(0.0, -along[2]) : 0.0;
  s.foot = plane == PlaneName::front || plane == PlaneName::back;
  return s;
}

std::vector<PlaneEdge> cuboid_edges(const CuboidCells& c, const std::array<bool, 4>& has_rim) {
  using P = PlaneName;
  using S = SideName;
  using K = PlaneEdge::Kind;
  const P nothing = P::none;
  // With the slope, around the footprint; the uprights; round the top.
  std::vector<PlaneEdge> edges = {
      {K::concave, {P::slope, S::upstream}, {P::front, S::upstream}, c.ny, c.dy},
      {K::concave, {P::slope, S::downstream}, {P::back, S::upstream}, c.ny, c.dy},
      {K::concave, {P::slope, S::left}, {P::left, S::left}, c.nx, c.dx},
      {K::concave, {P::slope, S::right}, {P::right, S::left}, c.nx, c.dx},
      {K::convex, {P::front, S::left}, {P::left, S::upstream}, c.nz, c.dz},
      {K::convex, {P::front, S::right}, {P::right, S::upstream}, c.nz, c.dz},
      {K::shed, {P::left, S::downstream}, {P::slope, S::left}, c.nz, c.dz},
      {K::shed, {P::right, S::downstream}, {P::slope, S::right}, c.nz, c.dz},
      {K::closed, {P::back, S::left}, {nothing, S::left}, c.nz, c.dz},
      {K::closed, {P::back, S::right}, {nothing, S::right}, c.nz, c.dz},
      {K::convex, {P::front, S::downstream}, {P::top, S::upstream}, c.ny, c.dy},
      {K::convex, {P::back, S::downstream}, {P::top, S::downstream}, c.ny, c.dy},
      {K::convex, {P::left, S::right}, {P::top, S::left}, c.nx, c.dx},
      {K::convex, {P::right, S::right}, {P::top, S::right}, c.nx, c.dx},
  };
  const auto missing = [&](P plane) {
    return plane < P::top && !has_rim[static_cast<int>(plane)];  // front, back, left, right stand on the rim's sides in order
  };
  std::erase_if(edges, [&](const PlaneEdge& e) {
    const P stands = e.kind == K::concave ? e.two.plane : e.one.plane;
    return e.kind != K::convex && missing(stands);
  });
  for (PlaneEdge& e : edges) {
    if (e.kind != K::convex || !(missing(e.one.plane) || missing(e.two.plane))) continue;
    if (missing(e.one.plane)) std::swap(e.one, e.two);
    if (missing(e.one.plane)) e.one = {};
    e.kind = K::domain, e.two = {};
  }
  std::erase_if(edges, [](const PlaneEdge& e) { return e.one.plane == P::none; });
  return edges;
}

}  // namespace couloir
