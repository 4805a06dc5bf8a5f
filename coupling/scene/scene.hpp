#pragma once
// A run as plain data: SI units, radians, complete (every default filled in). Made by the reader, used by everybody.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/scene/places.hpp"
#include "coupling/scene/solid_body.hpp"

namespace couloir {

enum class Mode { continuum, coupled, grains };
const char* to_string(Mode);

struct ProfileRow {
  double x = 0, angle = 0;  // [m] along the surface, [rad]
};

// A piece of the terrain along which its angle changes evenly with the way.
struct TerrainArc {
  double begin = 0, length = 0;                       // [m] along the surface
  double turn = 0;                                    // [rad] by which the slope is gentler at its end; negative over a brink
  double curvature() const { return turn / length; }  // [1/m]
};

struct TerrainSpec {
  enum class Kind { flat, incline, chute, profile } kind = Kind::incline;
  double angle = 0;                       // [rad] of the incline
  double length = 0;                      // [m] flat, incline: along the surface
  double slope = 0, arc = 0, runout = 0;  // [m] chute: lengths along the surface
  std::vector<ProfileRow> profile;        // its angle, linear between the rows
  double width = 0;                       // [m]; y runs from -width/2 to width/2
  double total_length() const;            // [m] along the surface
  bool level() const;                     // everywhere
  std::vector<TerrainArc> arcs() const;
};

struct GrainMaterial {
  double friction = 0.5;                // between grains [-]
  double base_friction = 0.4;           // grain on bed [-]
  double wall_friction = 0.5;           // grain on obstacle [-]
  double side_friction = 0.0;           // grain on side wall [-]
  double rolling_friction = 0.15;       // between grains [-]
  double base_rolling_friction = 0.15;  // grain on bed, obstacle and sides [-]
  double restitution = 0.5;             // [-]
  double youngs_modulus = 0;            // [Pa] 0: as the flow's speed asks, stiffness.hpp
  double poisson_ratio = 0.25;          // [-]
};

struct Material {
  std::string name;
  double density = 0;   // [kg/m3] bulk
  double phi = 0;       // [rad] internal friction angle
  double delta = 0;     // [rad] basal friction angle
  double diameter = 0;  // [m] mean grain diameter of the real material; 0: not known
  GrainMaterial grain;
  std::string source;       // where the numbers come from
  std::string calibration;  // record that the grains' frictions come from; empty: none
};

struct ReleaseSpec {
  enum class Kind { cap, ellipsoid, block, uniform, none } kind = Kind::cap;
  double x = 0, y = 0;                        // [m] centre (cap, ellipsoid); upper edge and centre line (block)
  double base_radius = 0, height = 0;         // [m] cap: spherical; block, uniform: height is the depth
  double semi_x = 0, semi_y = 0, semi_z = 0;  // [m] ellipsoid
  double length = 0, width = 0;               // [m] block
  double velocity = 0, velocity_across = 0;   // [m/s] downslope and towards the right (y high), at the start
  double mass = 0;                            // [kg] 0: what the geometry holds; else the depth is scaled to hold it
  double speed() const { return std::hypot(velocity, velocity_across); }  // [m/s]
};

struct ObstacleSpec {
  // tetrahedron: on a triangle with one corner upstream and an edge across the slope downstream, peak above its centre (4.2),
  // (4.3); mesh: any body of triangles
  enum class Shape { cuboid, tetrahedron, mesh };
  // What the continuum makes of it: a jump of the bed, a smooth bed height z_b(x, y), or planes of its own (chapter 6).
  enum class Method { step, elevation, planes };

  std::string name;
  // [m] middle of the upstream edge of the footprint; tetrahedron: its upstream corner; mesh: of the box around it, seen from
  // above
  double x = 0, y = 0;
  double length = 0, width = 0, height = 0;  // [m] of the base along the slope and across it; along the normal
  Shape shape = Shape::cuboid;
  Method method = Method::step;
  double ramp = 0;                // [m] cuboid by elevation: length within which its sides rise; 0: automatic
  double eta = 0.8;               // planes: share of the velocity that the edge at its foot passes on
  std::string overflow = "warn";  // planes: | error, when material comes over its upper edges

  // Of a mesh: where it comes from, and its triangles in that file's frame, in metres. bodies.hpp makes the rest of them.
  std::string file;                       // as given, from the scene's folder
  std::string unit = "mm";                // of the file's numbers
  double rotation = 0;                    // [rad] about the normal, counter-clockwise seen from above
  std::vector<BodyPoint> vertices;        // [m]
  std::vector<std::array<int, 3>> faces;  // numbers of vertices, counter-clockwise seen from outside
  std::shared_ptr<const SolidBody> body;  // turned; length, width and height are those of the box around it

  bool covers(double x, double y) const;  // whether its base holds this place, edge included; mesh: whether it is over it
  double base_area() const;               // [m2] of that
  double crest_x() const;                 // [m] the line across the slope that material must pass to have come over it ...
  double crest_y() const;                 // [m] ... the middle of the obstacle there ...
  double crest_width() const;             // [m] ... and its width
  double top(double x, double y) const;   // [m] mesh: of its upper surface, 0 beside it
};

// A part of a cuboid's upstream face on which the grains' stresses are read; stress_gauge.hpp has its outline.
struct StressGaugeSpec {
  std::string name;
  int obstacle = 0;              // number
  double across = 0, up = 0;     // [m] its middle: from the face's middle to high y; over the face's foot
  double width = 0, height = 0;  // [m] of a rectangle
  double radius = 0;             // [m] of a round one; 0: a rectangle
};

struct InflowRow {
  double time = 0, depth = 0, velocity = 0;  // [s], [m], [m/s]
};

struct SideSpec {
  enum class Kind { wall, outflow, periodic, inflow } kind = Kind::outflow;
  bool open() const { return kind == Kind::outflow || kind == Kind::inflow; }  // material passes it
  // Inflow only; inflow.hpp tells what comes in.
  enum class Inflow { uniform, hydrograph, silo } inflow = Inflow::uniform;
  double depth = 0, velocity = 0;     // [m], [m/s] uniform
  std::vector<InflowRow> hydrograph;  // linear between its rows, nothing before and after them
  double gate = 0;                    // [m] silo: opening
};

// Finer cells in a rectangle: about an obstacle's base, or between given edges.
struct RefineSpec {
  std::string around;                                 // name of an obstacle; empty: x, y
  double up = 0, down = 0, left = 0, right = 0;       // [m] beyond its base: up and down the slope, to low and to high y
  enum class From { base, front } from = From::base;  // what `down` counts from: the base's downstream edge or its front edge
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;              // [m] without an obstacle
  int levels = 1;                                     // how often the cells are halved
  double margin = 0;                                  // [m] by which each parent is larger than its child; 0: automatic
};

// Finer cells where the flow asks for them.
struct AdaptSpec {
  int levels = 0;         // how often the cells may be halved; 0: never
  int interval = 8;       // steps of the coarsest cells between two looks
  bool front = true;      // where wet cells meet dry ones
  double gradient = 0.1;  // change of the surface from cell to cell over the greatest depth; 0: never
  double obstacle = 0;    // [m] about obstacles; 0: never
  bool zone = true;       // along the rim of the zone
};

struct ContinuumSpec {
  std::string scheme = "central_upwind";  // | noc
  double cell = 0;                        // [m]
  double cell_across = 0;                 // [m] 0: as cell
  double across() const { return cell_across > 0 ? cell_across : cell; }
  double cfl = 0.45;
  std::string closure = "active_passive";  // | hydraulic
  std::string limiter = "minmod";          // | van_leer | mc | superbee | eno
  std::string curvature = "automatic";     // | on | off
  int block = 0;                           // cells along a block's edge; 0: automatic
  std::vector<RefineSpec> refine;
  AdaptSpec adapt;
  bool refined() const { return !refine.empty() || adapt.levels > 0; }
};

struct ZoneBox {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;     // [m]
  bool holds(const ObstacleSpec& o) const {  // whole
    return o.x >= x0 && o.x + o.length <= x1 && o.y - o.width / 2 >= y0 && o.y + o.width / 2 <= y1;
  }
  bool apart(const ObstacleSpec& o) const {  // not even in part
    return o.x + o.length <= x0 || o.x >= x1 || o.y + o.width / 2 <= y0 || o.y - o.width / 2 >= y1;
  }
};

// Rotation control, (4.11)-(4.13); coupling/engine/rotation.hpp tells what they do.
struct RotationSpec {
  double retarding_time = 0;     // [s] lambda_c
  double contact_influence = 1;  // [-] chi
  double shear_influence = 0;    // [s2/m] k_v
  double slide_to_roll = 0;      // [m/s] v_sr
  double roll_to_slide = 0;      // [m/s] v_rs
};

struct GrainSpec {
  std::string engine = "liggghts";  // | yade
  std::string contact = "hertz";    // | kelvin_voigt
  bool tangential_damping = true;   // off: contacts slide as Coulomb's law says
  std::string rotation = "free";    // | blocked | control
  RotationSpec control;             // of rotation: control
  int ranks = 1;
  double diameter = 0;         // [m]
  double spread = 0.1;         // radii are uniform within +-spread of the mean
  std::vector<ZoneBox> zones;  // none: automatic
  bool follow = true;          // zones grow, shrink and end with the need
  int window = 40;             // engine steps in a coupling window
  double skin = 0;             // [m] of the neighbour lists; 0: the engine's worker chooses
  double timestep = 0;         // [s] 0: a fixed share of the Rayleigh time
  long seed = 20011;           // packing and radii
  int replicates = 1;          // runs, each with a packing of its own: seed, seed + 1, ...
  double timeout = 120;        // [s] without an answer from the engine before it counts as dead
};

// A point, or a rectangle laid out like an obstacle's base.
struct GaugeSpec {
  std::string name;
  double x = 0, y = 0;           // [m] the point; the middle of the rectangle's upstream edge
  double length = 0, width = 0;  // [m] of the rectangle; both 0: a point
};

struct RecordSpec {
  double frames = 0.02;   // [s] between frames
  double forces = 0.001;  // [s] between rows of forces.csv, at least
  double checkpoint = 0;  // [s] between checkpoints; 0: a twentieth of the duration
  std::vector<GaugeSpec> gauges;
};

struct Scene {
  std::string title;
  std::string file;  // as given on the command line
  std::string text;  // the file's own text
  Places places;
  Mode mode = Mode::coupled;
  double gravity = 9.81;  // [m/s2]
  TerrainSpec terrain;
  Material material;
  ReleaseSpec release;
  std::vector<ObstacleSpec> obstacles;
  std::vector<StressGaugeSpec> stress_gauges;  // obstacle by obstacle
  std::array<SideSpec, 4> sides{};             // upstream, downstream, left, right
  ContinuumSpec continuum;
  GrainSpec grains;
  RecordSpec record;
  std::vector<std::string> left_out;  // effects that the scene switches off by hand
  double duration = 0;                // [s]
  bool leaves_out(const std::string& effect) const { return std::ranges::find(left_out, effect) != left_out.end(); }
  bool fed() const {  // through some side
    return std::ranges::any_of(sides, [](const SideSpec& side) { return side.kind == SideSpec::Kind::inflow; });
  }
};

inline double checkpoint_interval(const Scene& s) {  // [s]
  return s.record.checkpoint > 0 ? s.record.checkpoint : s.duration / 20;
}

}  // namespace couloir
