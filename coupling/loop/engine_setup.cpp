#include "coupling/loop/engine_setup.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "coupling/loop/stress_gauges.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/stiffness.hpp"
#include "coupling/scene/bodies.hpp"
#include "coupling/scene/inflow.hpp"

namespace couloir {
namespace {

constexpr double open_margin = 15;  // [d] of bed beyond an open side
constexpr double box_margin = 10;   // [d] of room beyond the bed

double highest(const Scene& s) {
  double inflow = 0;
  for (const SideSpec& side : s.sides) inflow = std::max(inflow, greatest_inflow(s, side).depth);
  return std::max({s.release.height, s.release.semi_z, inflow, 4 * s.grains.diameter});
}

// [m] along the normal, anywhere down to `x`: falling from the upper edge with the release's own height can throw a grain this
// high, and no higher.
double throw_height(const Scene& s, const ReferenceSurface& surface, double x) {
  const double start = s.release.speed() * s.release.speed() / (2 * s.gravity);
  const auto level = [&](double at, double n) { return surface.to_level(surface.to_space({at, 0, n})).z(); };
  double height = 0;
  const int pieces = 64;
  for (int i = 0; i <= pieces; ++i) {
    const double at = x * i / pieces, drop = highest(s) + start - level(at, 0);
    height = std::max(height, drop / (level(at, 1) - level(at, 0)));
  }
  return height;
}

RotationControl rotation_control(const Scene& s) {
  const RotationSpec& c = s.grains.control;
  return {c.retarding_time, c.contact_influence, c.shear_influence, c.slide_to_roll, c.roll_to_slide};
}

EngineSetup material_setup(const Scene& s, const ReferenceSurface& surface, double density, const std::string& work_dir) {
  EngineSetup setup;
  const GrainMaterial& m = s.material.grain;
  setup.timestep = engine_timestep(s, density);
  const Eigen::Vector3d g = s.gravity * surface.gravity_direction();
  setup.gravity = {g.x(), g.y(), g.z()};
  setup.density = density;
  setup.max_radius = 0.5 * s.grains.diameter * (1 + s.grains.spread);
  setup.skin = s.grains.skin;
  setup.friction = m.friction;
  setup.rolling_friction = m.rolling_friction;
  setup.restitution = m.restitution;
  setup.youngs_modulus = youngs_modulus(s);
  setup.poisson_ratio = m.poisson_ratio;
  setup.contact = contact_law(s.grains.contact);
  setup.tangential_damping = s.grains.tangential_damping;
  setup.rotation = rotation(s.grains.rotation);
  setup.control = rotation_control(s);
  setup.linear = linear_contact(grain_stiffness(s, density), m.restitution);
  setup.ranks = s.grains.ranks;
  setup.timeout = s.grains.timeout;
  setup.work_dir = work_dir;
  return setup;
}

void add_bed(EngineSetup& setup, const Scene& s, const char* name, std::vector<Triangle> mesh) {
  const GrainMaterial& m = s.material.grain;
  setup.surfaces.push_back({name, std::move(mesh), m.base_friction, m.base_rolling_friction});
}

// Around the region's corners, along the surface, up to `height`.
void set_box(EngineSetup& setup, const Scene& s, const ReferenceSurface& surface, const Patch& region, double height) {
  const Extent around = extent(surface, region.x0, region.x1, height);
  const double margin = box_margin * s.grains.diameter;
  for (int q : {0, 2}) setup.lo[q] = around.lo[q] - margin, setup.hi[q] = around.hi[q] + margin;
  const bool periodic = s.sides[2].kind == SideSpec::Kind::periodic;
  setup.lo[1] = region.y0 - (periodic ? 0 : margin);
  setup.hi[1] = region.y1 + (periodic ? 0 : margin);
  setup.periodic = {false, periodic, false};
}

// `zone`: whose obstacles the grains meet; `region`: the bed that they have, margins included.
void add_obstacles_and_sides(EngineSetup& setup, const Scene& s, const ReferenceSurface& surface, const ZoneBox& zone,
                             const Patch& region, double height, double size) {
  const GrainMaterial& m = s.material.grain;
  for (int k = 0; k < int(s.obstacles.size()); ++k) {
    const ObstacleSpec& o = s.obstacles[std::size_t(k)];
    if (!zone.holds(o)) continue;
    std::vector<StressGaugeSpec> gauges;
    std::ranges::copy_if(s.stress_gauges, std::back_inserter(gauges), [&](const auto& g) { return g.obstacle == k; });
    ObstacleMesh mesh = obstacle_mesh(surface, o, size, gauges);
    const auto solid = [&](const std::string& name, std::vector<Triangle>& part) {
      setup.surfaces.push_back({name, std::move(part), m.wall_friction, m.base_rolling_friction});
    };
    solid(o.name, mesh.rest);
    for (std::size_t n = 0; n < gauges.size(); ++n) solid(surface_of({k, o.name, gauges[n].name}), mesh.gauges[n]);
  }
  // A side that lies on the domain's is off by rounding of the cell lines.
  const double half = s.terrain.width / 2, length = s.terrain.total_length(), near = 1e-9;
  const auto side = [&](const char* name, std::vector<Triangle> mesh) {
    setup.surfaces.push_back({name, std::move(mesh), m.side_friction, m.base_rolling_friction});
  };
  using Kind = SideSpec::Kind;
  if (s.sides[2].kind == Kind::wall && region.y0 < -half + near)
    side(side_surfaces[0], side_mesh(surface, region.x0, region.x1, -half, height, size));
  if (s.sides[3].kind == Kind::wall && region.y1 > half - near)
    side(side_surfaces[1], side_mesh(surface, region.x0, region.x1, half, height, size));
  if (s.sides[0].kind == Kind::wall && region.x0 < near)
    side(side_surfaces[2], end_mesh(surface, 0, region.y0, region.y1, height, size));
  if (s.sides[1].kind == Kind::wall && region.x1 > length - near)
    side(side_surfaces[3], end_mesh(surface, length, region.y0, region.y1, height, size));
}

// With edges along all lines that a zone's side can lie on.
std::vector<Triangle> bed_by_lines(const ReferenceSurface& surface, const ZoneLines& lines, const Patch& region, const Grid& grid,
                                   double size) {
  const auto edges = [](double from, const std::vector<int>& cells, double origin, double step, double to) {
    std::vector<double> at{from};
    for (const int c : cells)
      if (const double x = origin + c * step; x > at.back() + 0.01 * step && x < to - 0.01 * step) at.push_back(x);
    at.push_back(to);
    return at;
  };
  const auto x = edges(region.x0, lines.x, grid.x0, grid.dx, region.x1),
             y = edges(region.y0, lines.y, grid.y0, grid.dy, region.y1);
  std::vector<Triangle> bed;
  for (std::size_t b = 0; b + 1 < y.size(); ++b)
    for (std::size_t a = 0; a + 1 < x.size(); ++a)
      for (const Triangle& t : bed_mesh(surface, {x[a], x[a + 1], y[b], y[b + 1]}, size)) bed.push_back(t);
  return bed;
}

double mesh_size(const Scene& s) {
  return longest_edge(s.grains);
}

}  // namespace

PackingSpec packing_spec(const Scene& s, double depth) {
  const GrainMaterial& m = s.material.grain;
  const double d = s.grains.diameter;
  const bool periodic = s.sides[2].kind == SideSpec::Kind::periodic;
  PackingSpec spec;
  spec.timeout = s.grains.timeout;
  spec.diameter = d;
  spec.spread = s.grains.spread;
  spec.length = 20 * d;
  // Between periodic sides a whole number of blocks, so that they fit together there, too.
  spec.width = periodic ? s.terrain.width / std::max(1.0, std::floor(s.terrain.width / (20 * d))) : 20 * d;
  spec.depth = std::max(1.2 * depth, depth + 3 * d);
  spec.seed = s.grains.seed;
  spec.friction = m.friction;
  spec.base_friction = m.base_friction;
  spec.rolling_friction = m.rolling_friction;
  spec.base_rolling_friction = m.base_rolling_friction;
  spec.restitution = m.restitution;
  spec.youngs_modulus = youngs_modulus(s);
  spec.poisson_ratio = m.poisson_ratio;
  spec.density = expected_grain_density(s);
  spec.contact = contact_law(s.grains.contact);
  spec.tangential_damping = s.grains.tangential_damping;
  spec.rotation = rotation(s.grains.rotation);
  spec.control = rotation_control(s);
  return spec;
}

double grain_density(const Scene& s, const Packing& packing) {
  return s.material.density / packing.solid_fraction;
}

EngineSetup engine_setup_whole(const Scene& s, const ReferenceSurface& surface, double density, const std::string& work_dir) {
  EngineSetup setup = material_setup(s, surface, density, work_dir);
  const double margin = open_margin * s.grains.diameter, half = s.terrain.width / 2, length = s.terrain.total_length();
  const auto open = [&](int side) { return s.sides[side].open(); };
  const Patch region{open(0) ? -margin : 0, length + (open(1) ? margin : 0), -half - (open(2) ? margin : 0),
                     half + (open(3) ? margin : 0)};
  const double height = throw_height(s, surface, length);
  add_bed(setup, s, "bed", bed_mesh(surface, region, mesh_size(s)));
  add_obstacles_and_sides(setup, s, surface, {region.x0, region.x1, region.y0, region.y1}, region, height, mesh_size(s));
  set_box(setup, s, surface, region, height);
  return setup;
}

EngineSetup engine_setup_zone(const Scene& s, const ReferenceSurface& surface, const PlannedZone& planned, const Rim& rim,
                              double density, const std::string& work_dir) {
  EngineSetup setup = material_setup(s, surface, density, work_dir);
  const Grid grid = grid_of(s);
  const ZoneLines& lines = planned.lines;
  const ZoneBox z = box_of({lines.x.front(), lines.x.back(), lines.y.front(), lines.y.back()}, grid);
  Patch region{z.x0, z.x1, z.y0, z.y1};
  const double margin = rim.buffer() + open_margin * s.grains.diameter;
  const auto touches_open = [&](int side, bool touches) { return touches && s.sides[side].open(); };
  // Where the zone ends with an open domain, grains pass its side before they are taken out.
  const double half = s.terrain.width / 2, length = s.terrain.total_length(), near = 1e-9;
  if (touches_open(0, z.x0 < near)) region.x0 -= margin;
  if (touches_open(1, z.x1 > length - near)) region.x1 += margin;
  if (touches_open(2, z.y0 < -half + near)) region.y0 -= margin;
  if (touches_open(3, z.y1 > half - near)) region.y1 += margin;
  if (lines.x.front() > 0) region.x0 -= margin;
  if (lines.x.back() < grid.nx) region.x1 += margin;
  if (lines.y.front() > 0) region.y0 -= margin;
  if (lines.y.back() < grid.ny) region.y1 += margin;
  for (const RimFace& face : rim.faces()) setup.faces.push_back(face.drive);
  const double size = mesh_size(s);
  add_bed(setup, s, "bed", bed_by_lines(surface, lines, region, grid, size));
  const double height = throw_height(s, surface, z.x1);
  add_obstacles_and_sides(setup, s, surface, planned.box, region, height, size);
  set_box(setup, s, surface, region, height);
  return setup;
}

}  // namespace couloir
