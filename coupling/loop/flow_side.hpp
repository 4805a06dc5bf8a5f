#pragma once
// The solver's share of a run: built from the scene, read into the ledgers.

#include <memory>
#include <optional>

#include "continuum/flow_model.hpp"
#include "coupling/loop/force_measures.hpp"
#include "coupling/loop/observer.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

class PlanesModel;

class FlowSide {
 public:
  FlowSide(const Scene&, const ReferenceSurface&, int threads);

  FlowModel& model() { return *model_; }
  Solver& solver() { return *solver_; }  // of the coupled mode, whose scenes are central upwind
  const std::vector<double>& bed() const { return bed_; }
  double density() const { return density_; }            // [kg/m3]
  double initial_mass() const { return initial_mass_; }  // [kg]

  void advance_to(double t);           // [s]; counts CPU
  double cpu() const { return cpu_; }  // [s]

  // Takes up the other measures of force; zone: the cells that will be covered, may be empty. report() then fills them in.
  const std::vector<ForceMeasure>& measure(const Scene&, const ReferenceSurface&, const CellBox& zone);

  // Ledger entries of the solver since the last call: mass state, momentum terms, counters.
  void report(WindowReport&);
  double momentum() const;                           // [N s] along x, present
  ObstacleForce force(int obstacle, double window);  // mean since the last call for this obstacle
  // [kg] since the start, through the plane of its middle; where it is made of planes, over its upper edges.
  double overtopped(int obstacle) const;
  int planes_obstacle() const { return planes_obstacle_; }  // number of the one that is made of planes; -1: none

  FrameView frame();

 private:
  void lay_top(const ObstacleSpec&, int id, const StepBed&);
  int add_gauge(const ObstacleSpec&);
  void gather_planes();

  double density_;
  std::unique_ptr<FlowModel> model_;
  Solver* solver_ = nullptr;  // the same, where the scheme is central upwind and no obstacle is made of planes
  PlanesModel* planes_ = nullptr;
  int planes_obstacle_ = -1;
  double least_climbing_ = 0;  // [m] thinner material does not count as having climbed
  std::vector<PlaneView> plane_views_;
  std::vector<double> bed_;
  std::vector<int> gauge_;                      // by obstacle
  std::vector<std::array<double, 2>> impulse_;  // by obstacle, at the last call
  struct Cell {
    int i, j;
  };
  std::vector<std::vector<Cell>> top_;  // by obstacle: the cells of its top
  std::optional<ForceMeasures> measures_;
  std::vector<double> h_, hu_, hv_;
  double initial_mass_ = 0, boundary_mass_ = 0, inflow_mass_ = 0, copied_mass_ = 0, momentum_before_ = 0, cpu_ = 0;
};

}  // namespace couloir
