#pragma once
// Inside the planes model: slope, planes, edges, and the order of a step.

#include <cstdint>
#include <vector>

#include "continuum/planes/planes_model.hpp"
#include "continuum/scheme/laps.hpp"
#include "continuum/solver.hpp"

namespace couloir {

struct PlanesModel::Impl {
  Impl(const SolverSettings&, const ReferenceSurface&, const StepBed&, int cuboid, double eta);

  // The step (exchange.cpp).
  void step(double dt);
  double stable_dt();
  void refresh();  // the planes' closures, if the state has changed
  void find_fluxes(double dt);
  void take_passed(double dt);  // what the slope really gave
  void book_edges(double dt);
  void book_planes(double dt, double front_volume);

  EdgeCell cell(const PlaneSide&, int k) const;
  double most(const PlaneSide&, int k, double dt) const;  // [m2/s] that the cell there may give in dt
  void impose(const PlaneSide&, int k, double mass_out, double along_out, double normal);
  struct Shed {
    double mass = 0, along = 0;  // [m2/s], [m3/s2] onto the slope, per length of the face there
  };
  const Shed& shed_at(const PlaneEdge&, int k) const;
  CellBox slope_cell(SideName, int k) const;  // beside the rim, as a box of one cell

  PlaneFlow& plane(PlaneName p) { return planes[static_cast<std::size_t>(p)]; }
  const PlaneFlow& plane(PlaneName p) const { return planes[static_cast<std::size_t>(p)]; }

  CellBox box;  // footprint
  CuboidCells cells;
  int cuboid;
  double eta, dry_depth;
  Solver slope;
  int hole = -1;                                  // the covered zone under the cuboid
  std::array<std::vector<double>, 4> rim_weight;  // [m/s2] g cos(zeta) at the rim's faces, by SideName
  std::vector<PlaneFlow> planes;                  // by PlaneName
  std::vector<PlaneEdge> edges;
  std::vector<std::vector<EdgeFlux>> flux;  // by edge and face, of this step
  std::array<Shed, 4> shed{};               // of this step, by the rim's side
  bool fresh = false;
  Budget extra, sum;                // of edges and planes since the last reset; with the slope's
  std::array<double, 2> impulse{};  // on the cuboid [m4/s]
  // What moved the planes' material and no body did (weight, walls, films' cut-off), less the momentum it has: what bodies took.
  std::array<double, 2> planes_momentum() const;
  std::array<double, 2> taken() const;
  std::array<double, 2> moved{};  // [m4/s] since the start
  struct Round {
    int id;                         // the slope's box
    std::array<double, 2> taken{};  // before
  };
  std::vector<Round> rounds;  // boxes that hold the cuboid
  double time = 0, overflow = 0;
  StepTimer timer;  // of planes and edges alone
};

}  // namespace couloir
