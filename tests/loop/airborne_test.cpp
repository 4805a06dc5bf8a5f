// Grains thrown over a low wall: out of the engine, through the air, into the flow.

#include <cmath>

#include "../transfer/stock.hpp"
#include "coupling/engine/worker_engine.hpp"
#include "coupling/transfer/zone.hpp"
#include "small_run.hpp"

namespace couloir {
namespace {

constexpr double d = 0.005, g = 9.81, zeta = 0.5;

std::vector<Triangle> rectangle(double x0, double x1, double y0, double y1, double z0, double z1) {
  const Vec a{x0, y0, z0}, b{x1, y0, z1}, c{x1, y1, z1}, e{x0, y1, z0};
  return {{a, b, c}, {a, c, e}};
}

// The engine's part is a floor and a wall of 20 mm at x = 0.7 m; the zone ends at x = 0.9 m.
struct Throw {
  Grid grid{100, 20, 0.02, 0.02, 0, -0.2};
  ReferenceSurface surface = ReferenceSurface::incline(zeta, 2);
  PackingTable table{lattice_packing(d), 1500};
  Solver solver{settings(), surface, {}};
  Zone zone{{.box = {20, 45, 4, 16}, .rim = {.diameter = d, .anchor = {}}}, grid, surface, table};
  Airborne air{
      {grid,
       {AirborneSettings::Edge::open, AirborneSettings::Edge::open, AirborneSettings::Edge::wall, AirborneSettings::Edge::wall},
       std::vector<double>(2000, 0.0),
       g,
       table.bulk_density()},
      surface};
  WorkerEngine engine{worker_path("liggghts", COULOIR_BINARY_DIR "/bin")};
  double timestep = stable_timestep(ContactLaw::hertz, {d, 0.1, 1500, 5e6, 0.25});

  SolverSettings settings() const {
    SolverSettings s;
    s.grid = grid;
    s.closure = {EarthPressure::hydraulic(), 0.4, false};
    return s;
  }
  void start(const std::string& folder) {
    EngineSetup s;
    s.timestep = timestep;
    s.gravity = {g * std::sin(zeta), 0, -g * std::cos(zeta)};
    s.lo = {0.2, -0.3, -0.02}, s.hi = {1.3, 0.3, 0.4};
    s.density = 1500, s.max_radius = 0.5 * d;
    s.work_dir = folder;
    s.surfaces = {{"floor", rectangle(0.2, 1.3, -0.3, 0.3, 0, 0), 0.4, 0.1},
                  {"wall", rectangle(0.7, 0.7 + 1e-6, -0.1, 0.1, 0, 0.02), 0.4, 0.1}};
    for (const RimFace& face : zone.rim().faces()) s.faces.push_back(face.drive);
    engine.start(s);
  }
};

// From height n0 thrown up at w to height n1.
double time_down(double n0, double n1, double w) {
  const double gn = g * std::cos(zeta);
  return (w + std::sqrt(w * w + 2 * gn * (n0 - n1))) / gn;
}

TEST(AirborneLoop, GrainsThrownOverALowWallLandWhereBallisticsSays) {
  Throw all;
  EXPECT_TRUE(all.zone.take_over(all.solver).empty());
  all.start(fresh_folder("throw"));
  std::vector<NewGrain> thrown;
  double mass = 0, on_the_bed = 0;
  for (int n = 0; n < 8; ++n) {
    thrown.push_back({n + 1, {0.55, -0.07 + 0.02 * n, 0.012}, {1.4 + 0.04 * n, 0, 1.2 - 0.03 * n}, (0.45 + 0.005 * n) * d});
    mass += all.table.grain_mass(thrown.back().radius);
  }
  std::vector<NewGrain> insert = thrown;
  for (int n = 0; n < 4; ++n) {  // and some that slide out
    insert.push_back({100 + n, {0.84, -0.07 + 0.02 * n, 0.5 * d}, {1.2, 0, 0}, 0.5 * d});
    on_the_bed += all.table.grain_mass(0.5 * d);
  }
  const double total = mass + on_the_bed;
  const std::int64_t steps = std::llround(1e-3 / all.timestep);
  const double window = steps * all.timestep;
  std::vector<Airborne::Landing> landings;
  double most = 0, landed = 0;
  for (int k = 1; k <= 450 && landings.size() < thrown.size(); ++k) {
    all.zone.begin_window(steps, window);
    all.zone.impose(all.solver);
    all.solver.advance_to(k * window);
    all.air.advance(window, all.solver);
    landings.insert(landings.end(), all.air.landings().begin(), all.air.landings().end());
    for (const auto& l : all.air.landings()) landed += l.mass;
    AdvanceRequest request = all.zone.request(all.solver);
    request.insert.insert(request.insert.end(), insert.begin(), insert.end());
    insert.clear();
    const Advanced advanced = all.engine.advance(request);
    all.zone.absorb(advanced, all.solver, &all.air);
    most = std::max(most, all.air.mass());
    const double there = all.table.bulk_density() * all.solver.volume() + all.zone.faces_mass() +
                         all.zone.grains_mass(advanced.grains) + all.air.mass() + all.air.left() -
                         all.table.bulk_density() * all.solver.budget().mass_boundary;
    ASSERT_NEAR(there, total, 1e-12 * total) << k;
  }
  ASSERT_EQ(landings.size(), thrown.size());
  EXPECT_NEAR(most, mass, 1e-15) << "all that was thrown was in the air at once, nothing that slid";
  EXPECT_NEAR(landed, mass, 1e-15);
  EXPECT_EQ(all.zone.returned(), 12);
  double centre = 0, ballistic = 0;
  for (const NewGrain& n : thrown) {
    const auto l = std::find_if(landings.begin(), landings.end(),
                                [&](const auto& found) { return std::abs(found.at.y - n.position[1]) < 1e-6; });
    ASSERT_NE(l, landings.end()) << n.id;
    const auto range = [&](double height) {
      const double t = time_down(n.position[2], height, n.velocity[2]);
      return n.position[0] + n.velocity[0] * t + 0.5 * g * std::sin(zeta) * t * t;
    };
    EXPECT_NEAR(l->at.x, range(l->at.n), 1e-9) << n.id;
    EXPECT_NEAR(l->along, n.velocity[0] + g * std::sin(zeta) * time_down(n.position[2], l->at.n, n.velocity[2]), 1e-8);
    const double m = all.table.grain_mass(n.radius);
    centre += m * l->at.x / mass, ballistic += m * range(0) / mass;
  }
  EXPECT_NEAR(centre, ballistic, 1e-3);
  EXPECT_GT(ballistic, 1.1) << "0.2 m beyond the zone";
}

// A fast flow against a low wall: some of it flies, the ledgers close, and what the run says of it is consistent.
TEST(AirborneLoop, AFastFlowOverALowWallFliesAndComesDown) {
  const Scene scene =
      small_scene("coupled", {{"terrain.length", "1.2 m"},
                              {"release",
                               "{kind: block, position: [100 mm, 0], length: 100 mm, width: 60 mm, height: 20 mm, "
                               "velocity: 2.5 m/s}"},
                              {"obstacles.wall.size", "[10 mm, 100 mm, 15 mm]"},
                              {"duration", "0.4 s"}});
  const Watched run = watch(scene, options_in(fresh_folder("fast_over_wall")));
  ASSERT_EQ(run.end.status, "done");
  double most = 0;
  for (const WindowReport& w : run.windows) {
    most = std::max(most, w.mass.airborne);
    EXPECT_LT(w.mass.relative_error(), 1e-12) << w.time;
    EXPECT_GE(w.mass.airborne, 0);
  }
  EXPECT_GT(most, 0.01 * run.windows.front().mass.initial);
}

}  // namespace
}  // namespace couloir
