#include "coupling/plan/build.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "coupling/scene/depths.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/refine.hpp"

namespace couloir {
namespace {

// With 40 significant bits the products (j + 1/2) dy are exact, so that rows mirrored about y = 0 have mirrored centres to the
// bit. Changes the width by less than 1e-12 of it.
double short_mantissa(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, 40)), exponent - 40);
}

Limiter limiter_of(const std::string& word) {
  if (word == "van_leer") return Limiter::van_leer;
  if (word == "mc") return Limiter::mc;
  if (word == "superbee") return Limiter::superbee;
  if (word == "eno") return Limiter::eno;
  return Limiter::minmod;
}

Side side_of(const Scene& scene, const SideSpec& spec) {
  Side side;
  switch (spec.kind) {
    case SideSpec::Kind::wall:
      side.kind = Side::Kind::wall;
      break;
    case SideSpec::Kind::outflow:
      side.kind = Side::Kind::outflow;
      break;
    case SideSpec::Kind::periodic:
      side.kind = Side::Kind::periodic;
      break;
    case SideSpec::Kind::inflow:
      side.kind = Side::Kind::inflow;
      break;
  }
  const GreatestInflow inflow = greatest_inflow(scene, spec);
  side.depth = inflow.depth;
  side.velocity = inflow.velocity;
  if (spec.kind == SideSpec::Kind::inflow && spec.inflow == SideSpec::Inflow::hydrograph)
    for (const InflowRow& row : spec.hydrograph) side.hydrograph.push_back({row.time, row.depth, row.velocity});
  return side;
}

std::function<double(double x, double y)> upper_surface(const ObstacleSpec& mesh) {
  return [body = mesh.body, x0 = mesh.x, y0 = mesh.y](double x, double y) { return body->top(x - x0, y - y0); };
}

Refinement refinement_of(const Scene& scene) {
  Refinement out;
  for (const RefineSpec& r : scene.continuum.refine) {
    const RefineRectangle b = within_domain(scene, refine_rectangle(scene, r));
    out.boxes.push_back({b.x0, b.x1, b.y0, b.y1, r.levels, r.margin});
  }
  const AdaptSpec& a = scene.continuum.adapt;
  out.adaptive = {a.levels, a.interval, a.front, a.gradient, a.obstacle, a.zone};
  return out;
}

}  // namespace

Grid grid_of(const Scene& scene) {
  const double length = scene.terrain.total_length(), width = scene.terrain.width;
  const double cell = scene.continuum.cell > 0 ? scene.continuum.cell : 2 * scene.grains.diameter;
  const double across = scene.continuum.cell > 0 ? scene.continuum.across() : cell;
  Grid grid;
  grid.nx = std::max(4, static_cast<int>(std::lround(length / cell)));
  const bool one_row = scene.mode == Mode::continuum && width < 1.5 * across;
  grid.ny = one_row ? 1 : 2 * std::max(1, static_cast<int>(std::lround(width / (2 * across))));
  grid.dx = length / grid.nx;
  grid.dy = short_mantissa(width / grid.ny);
  grid.x0 = 0;
  grid.y0 = -0.5 * grid.ny * grid.dy;
  return grid;
}

Closure closure_of(const Scene& scene) {
  Closure closure;
  closure.earth_pressure = scene.continuum.closure == "hydraulic" || scene.mode == Mode::grains
                               ? EarthPressure::hydraulic()
                               : EarthPressure::active_passive(scene.material.phi, scene.material.delta);
  closure.tan_delta = scene.leaves_out("basal_friction") ? 0 : std::tan(scene.material.delta);
  const bool curved = !scene.terrain.arcs().empty();
  closure.curvature = curved && closure.tan_delta > 0 && scene.continuum.curvature != "off";
  return closure;
}

SolverSettings solver_settings(const Scene& scene) {
  SolverSettings settings;
  settings.grid = grid_of(scene);
  settings.gravity = scene.gravity;
  settings.closure = closure_of(scene);
  settings.limiter = limiter_of(scene.continuum.limiter);
  std::ranges::transform(scene.sides, settings.sides.begin(), [&](const SideSpec& s) { return side_of(scene, s); });
  settings.cfl = scene.continuum.cfl;
  settings.dry_depth = dry_depth(scene);
  settings.block = block_edge(scene);
  settings.refinement = refinement_of(scene);
  return settings;
}

StepBed step_bed(const Scene& scene) {
  StepBed bed;
  for (const ObstacleSpec& o : scene.obstacles) {
    const double step = o.method == ObstacleSpec::Method::elevation ? 0 : o.height;
    bed.obstacles.push_back({o.name, o.x, o.x + o.length, o.y - o.width / 2, o.y + o.width / 2, step});
    if (step > 0 && o.shape == ObstacleSpec::Shape::mesh) bed.obstacles.back().shape = upper_surface(o);
  }
  const Elevation smooth = elevation(scene);
  if (smooth.empty()) return bed;
  bed.height = smooth;
  bed.owner_at = [smooth](double x, double y) { return smooth.at(x, y) > 0 ? smooth.obstacle_at(x, y) : -1; };
  const Grid grid = grid_of(scene);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      bed.elevation.push_back(bed.height(grid.x(i), grid.y(j)));
      bed.owner.push_back(bed.owner_at(grid.x(i), grid.y(j)));
    }
  }
  return bed;
}

// check_scene lets no step obstacle through to this scheme.
NocBed noc_bed(const Scene& scene) {
  NocBed bed;
  const Elevation smooth = elevation(scene);
  for (const ElevationBody& body : smooth.bodies()) bed.obstacles.push_back([body](double x, double y) { return body.at(x, y); });
  return bed;
}

Elevation elevation(const Scene& scene) {
  Elevation all;
  const Grid grid = grid_of(scene);
  const double cell = std::min(grid.dx, grid.dy);
  for (std::size_t n = 0; n < scene.obstacles.size(); ++n) {
    const ObstacleSpec& o = scene.obstacles[n];
    if (o.method != ObstacleSpec::Method::elevation) continue;
    const int id = static_cast<int>(n);
    if (o.shape == ObstacleSpec::Shape::tetrahedron) {
      all.add(ElevationBody::tetrahedron(id, o.name, o.x, o.y, o.length, o.width, o.height));
      continue;
    }
    if (o.shape == ObstacleSpec::Shape::mesh) {
      all.add(ElevationBody::surface(id, o.name, o.x, o.x + o.length, o.y - o.width / 2, o.y + o.width / 2, o.height,
                                     upper_surface(o)));
      continue;
    }
    // In so short a ramp no cell's centre may lie, but the body keeps its height.
    const double ramp = o.ramp > 0 ? o.ramp : std::min(cell, std::min(o.length, o.width) / 4);
    all.add(ElevationBody::cuboid(id, o.name, o.x, o.x + o.length, o.y - o.width / 2, o.y + o.width / 2, o.height, ramp, ramp));
  }
  return all;
}

ReferenceSurface reference_surface(const Scene& scene) {
  const TerrainSpec& t = scene.terrain;
  switch (t.kind) {
    case TerrainSpec::Kind::flat:
      return ReferenceSurface::flat(t.length);
    case TerrainSpec::Kind::incline:
      return ReferenceSurface::incline(t.angle, t.length);
    case TerrainSpec::Kind::chute:
      return ReferenceSurface::chute(t.angle, t.slope, t.arc, t.runout);
    case TerrainSpec::Kind::profile:
      break;
  }
  std::vector<ProfilePoint> stations;
  for (const ProfileRow& row : t.profile) stations.push_back({row.x, row.angle});
  return ReferenceSurface::profile(stations);
}

ZoneBox box_of(const CellBox& c, const Grid& grid) {
  return {grid.x0 + c.i0 * grid.dx, grid.x0 + c.i1 * grid.dx, grid.y0 + c.j0 * grid.dy, grid.y0 + c.j1 * grid.dy};
}

CellBox cells_in(const ZoneBox& box, const Grid& grid) {
  const auto line = [](double edge, double origin, double step, int n) {
    const double at = (edge - origin) / step;
    // An edge midway between two lines goes outwards from the origin, whichever way round-off leans.
    return std::clamp(static_cast<int>(std::lround(at + (at > 0 ? 1e-9 : -1e-9))), -n, n);
  };
  const int half = grid.ny / 2;  // lines across are counted from y = 0, so that a symmetric box stays symmetric
  return {std::max(0, line(box.x0, grid.x0, grid.dx, grid.nx)), std::max(0, line(box.x1, grid.x0, grid.dx, grid.nx)),
          half + line(box.y0, 0, grid.dy, half), half + line(box.y1, 0, grid.dy, half)};
}

double expected_grain_density(const Scene& scene) {
  return scene.material.density / expected_solid_fraction;
}

double mean_grain_volume(const GrainSpec& grains) {
  const double d = grains.diameter, s = grains.spread;
  return std::numbers::pi / 6 * d * d * d * (1 + s * s);
}

}  // namespace couloir
