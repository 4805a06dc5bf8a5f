#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/transfer/zone.hpp"
#include "stock.hpp"

namespace couloir {
namespace {

constexpr double d = 0.005, angle = 0.6, h = 0.03, u = 0.8;

// A uniform flow down an incline; a zone whose engine only keeps what it is told.
struct Bench {
  PackingTable table{lattice_packing(d, 20, 14), 2500};
  ReferenceSurface surface = ReferenceSurface::incline(angle, 0.8);
  Solver solver{settings(), surface, {}};
  Grains grains;
  std::unique_ptr<Zone> zone;
  double initial = 0;

  static SolverSettings settings() {
    SolverSettings s;
    s.grid = {80, 40, 0.01, 0.01, 0, -0.2};
    return s;
  }
  ZoneSettings at(const CellBox& box) {
    ZoneSettings s;
    s.box = box;
    s.rim.diameter = d;
    s.rim.anchor = {0.3, -0.1};
    return s;
  }
  explicit Bench(const CellBox& box = {30, 60, 10, 30}) {
    solver.set([](double, double) { return FlowState{h, h * u, 0}; });
    initial = solver.volume() * table.bulk_density();
    zone = std::make_unique<Zone>(at(box), solver.grid(), surface, table);
    apply({.insert = zone->take_over(solver)});
    window();
  }
  double mass() const { return solver.volume() * table.bulk_density() + zone->grains_mass(grains) + zone->faces_mass(); }
  Zone::Moved move(const CellBox& box) {
    auto next = std::make_unique<Zone>(at(box), solver.grid(), surface, table);
    const auto moved = next->take_from(*zone, grains, solver);
    zone = std::move(next);
    window();
    return moved;
  }
  // Nothing moves in it.
  void window() {
    zone->begin_window(1, 1e-9);
    apply(zone->request(solver));
  }
  // After an advance in which rafts did not move; what the test does to `grains` is what the engine did.
  void absorb() {
    Advanced a;
    a.grains = grains;
    for (const RimFace& face : zone->rim().faces()) a.segments.emplace_back(face.segments);
    zone->absorb(a, solver);
  }
  std::size_t driven_nearest(const RimFace& face) const {  // to its plane
    std::size_t found = 0;
    double nearest = -1;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const Vec p{grains.x[i], grains.y[i], grains.z[i]};
      const double s = face.distance(p), along = face.along(p);
      if (grains.driven[i] && s < 0 && s > nearest && along > 0.05 && along < face.extent() - 0.05) found = i, nearest = s;
    }
    return found;
  }
  void put(std::size_t i, const Vec& p) { grains.x[i] = p[0], grains.y[i] = p[1], grains.z[i] = p[2]; }
  void apply(const AdvanceRequest& r) {
    std::map<std::int64_t, std::array<double, 8>> all;
    for (std::size_t i = 0; i < grains.size(); ++i)
      all[grains.id[i]] = {grains.x[i],  grains.y[i],  grains.z[i],      grains.vx[i],
                           grains.vy[i], grains.vz[i], grains.radius[i], double(grains.driven[i])};
    for (const RimMove& rim : r.rim_moves) {
      for (auto& [id, g] : all) g[7] = 0;
      for (const Regrouped& g : rim.driven) all.at(g.id)[7] = 1;
    }
    for (const std::int64_t id : r.remove) ASSERT_EQ(all.erase(id), 1u);
    for (const NewGrain& g : r.insert) {
      const bool fresh = all.try_emplace(g.id, std::array{g.position[0], g.position[1], g.position[2], g.velocity[0],
                                                          g.velocity[1], g.velocity[2], g.radius, double(g.segment >= 0)})
                             .second;
      ASSERT_TRUE(fresh);
    }
    grains = {};
    for (const auto& [id, g] : all) {
      grains.id.push_back(id);
      grains.x.push_back(g[0]), grains.y.push_back(g[1]), grains.z.push_back(g[2]);
      grains.vx.push_back(g[3]), grains.vy.push_back(g[4]), grains.vz.push_back(g[5]);
      grains.radius.push_back(g[6]), grains.driven.push_back(std::int8_t(g[7]));
    }
  }
  double mass_between(double x0, double x1, bool counted) const {
    double sum = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const auto p = surface.to_surface({grains.x[i], grains.y[i], grains.z[i]});
      if (p.x >= x0 && p.x < x1 && std::abs(p.y) < 0.1 && (!counted || zone->is_counted(grains.id[i])))
        sum += table.grain_mass(grains.radius[i]);
    }
    return sum;
  }
  double worst_overlap() const {  // [d] among all
    double worst = 0;
    for (std::size_t i = 0; i < grains.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const double dx = grains.x[i] - grains.x[k], dy = grains.y[i] - grains.y[k], dz = grains.z[i] - grains.z[k];
        const double reach = grains.radius[i] + grains.radius[k];
        if (std::abs(dx) < reach && std::abs(dy) < reach && std::abs(dz) < reach)
          worst = std::max(worst, 1 - std::sqrt(dx * dx + dy * dy + dz * dz) / reach);
      }
    return worst;
  }
};

TEST(ZoneMove, KeepsTheMassWhereverItGoes) {
  Bench b;
  EXPECT_NEAR(b.mass(), b.initial, 1e-12 * b.initial);
  for (const CellBox& box : {CellBox{22, 60, 10, 30}, CellBox{22, 66, 10, 30}, CellBox{22, 66, 4, 36}, CellBox{22, 66, 10, 30},
                             CellBox{30, 66, 10, 30}, CellBox{30, 60, 10, 30}}) {
    b.move(box);
    EXPECT_NEAR(b.mass(), b.initial, 1e-12 * b.initial) << box.i0 << " " << box.i1 << " " << box.j0 << " " << box.j1;
    EXPECT_LT(b.worst_overlap(), 0.25) << "no deeper than in the packing itself";
    for (std::size_t i = 0; i < b.grains.size(); ++i) {
      if (!b.grains.driven[i]) continue;
      double nearest = -1;
      for (const RimFace& face : b.zone->rim().faces())
        nearest = std::max(nearest, std::min(0.0, face.distance({b.grains.x[i], b.grains.y[i], b.grains.z[i]})));
      EXPECT_GE(nearest, -b.zone->rim().layer() - 1e-9) << "driven grains stand in a layer";
    }
  }
}

TEST(ZoneMove, FlowThatIsCoveredBecomesGrainsOfItsDepthAndVelocity) {
  Bench b;
  const auto moved = b.move({20, 60, 10, 30});
  const double area = 0.1 * 0.2, flow = h * area * b.table.bulk_density();
  EXPECT_NEAR(moved.covered, flow, 1e-12 * flow);
  EXPECT_EQ(moved.opened, 0);
  EXPECT_NEAR(b.mass_between(0.2, 0.3, true), flow, 0.05 * flow) << "old layer and new grains together, but for the seam";
  EXPECT_NEAR(moved.left_over, 0, 0.06 * flow);
  for (std::size_t i = 0; i < b.grains.size(); ++i) EXPECT_NEAR(b.grains.vx[i], u, 1e-12);
}

TEST(ZoneMove, GrainsOfCellsThatOpenBecomeTheirFlow) {
  Bench b;
  b.move({20, 60, 10, 30});
  const double there = b.mass_between(0.2, 0.3, true);
  const auto moved = b.move({30, 60, 10, 30});
  EXPECT_NEAR(moved.opened, there, 1e-9 * there);
  EXPECT_EQ(moved.covered, 0);
  double volume = 0, momentum = 0;
  for (int j = 10; j < 30; ++j)
    for (int i = 20; i < 30; ++i) volume += b.solver.at(i, j).h, momentum += b.solver.at(i, j).hu;
  EXPECT_NEAR(volume * 1e-4 * b.table.bulk_density(), there, 1e-12 * there);
  EXPECT_NEAR(momentum / volume, u, 1e-9);
}

TEST(ZoneMove, SideBuffersBecomeGrainsOnceCounted) {
  Bench b;
  const double shadows = b.mass_between(0.3, 0.6, false) - b.mass_between(0.3, 0.6, true);
  EXPECT_NEAR(shadows, 0, 1e-12) << "within the zone all are counted";
  b.move({30, 60, 4, 36});
  EXPECT_NEAR(b.mass(), b.initial, 1e-12 * b.initial);
  EXPECT_NEAR(b.mass_between(0.3, 0.6, true), h * 0.3 * 0.2 * b.table.bulk_density(), 0.01 * b.initial);
}

TEST(ZoneLayer, CountsWhatAFaceHasLetGoOfAndNothingBefore) {
  Bench b;
  const RimFace& face = b.zone->rim().faces()[0];
  const std::size_t i = b.driven_nearest(face);
  const double m = b.table.grain_mass(b.grains.radius[i]), counted = b.zone->grains_mass(b.grains), owed = b.zone->faces_mass();
  ASSERT_TRUE(b.grains.driven[i]);
  EXPECT_FALSE(b.zone->is_counted(b.grains.id[i]));
  b.put(i, face.place(0.2 * d, face.along({b.grains.x[i], b.grains.y[i], b.grains.z[i]}), 0.5 * d));
  b.grains.driven[i] = 0;
  b.absorb();
  EXPECT_TRUE(b.zone->is_counted(b.grains.id[i]));
  EXPECT_NEAR(b.zone->grains_mass(b.grains) - counted, m, 1e-12);
  EXPECT_NEAR(b.zone->faces_mass() - owed, -m, 1e-12);
  EXPECT_NEAR(b.mass(), b.initial, 1e-12 * b.initial);
}

// Beside the zone the flow runs along the faces, and so do their layers.
TEST(ZoneLayer, LeavesAtTheEndOfItsFaceWithoutATrace) {
  Bench b;
  const RimFace& side = b.zone->rim().faces()[2];
  ASSERT_EQ(side.side, SideName::left);
  ASSERT_TRUE(side.slides);
  const std::size_t i = b.driven_nearest(side);
  ASSERT_TRUE(b.grains.driven[i]);
  const std::int64_t id = b.grains.id[i];
  const double owed = b.zone->faces_mass();
  b.put(i, side.place(-d, side.extent() + 0.1 * d, 0.5 * d));
  b.absorb();
  EXPECT_NEAR(b.zone->faces_mass(), owed, 1e-12);
  b.window();
  EXPECT_EQ(std::count(b.grains.id.begin(), b.grains.id.end(), id), 0);
  EXPECT_NEAR(b.mass(), b.initial, 1e-12 * b.initial);
}

// The engine that starts again never had what waited for its removal when the last one ended.
TEST(ZoneLayer, IsGoneAfterAWake) {
  Bench b;
  b.zone->take_out({b.grains.id[0]});
  EXPECT_TRUE(b.zone->awaits_removal(b.grains.id[0]));
  b.zone->rest(b.grains, b.solver);
  b.zone->wake();
  b.zone->begin_window(1, 1e-9);
  EXPECT_TRUE(b.zone->request(b.solver).remove.empty());
}

}  // namespace
}  // namespace couloir
