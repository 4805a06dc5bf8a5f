#pragma once
// The solver's share of a run: built from the scene, read into the ledgers.

#include <functional>
#include <memory>
#include <optional>

#include "continuum/flow_model.hpp"
#include "coupling/checkpoint/archive.hpp"
#include "coupling/loop/force_measures.hpp"
#include "coupling/loop/observer.hpp"
#include "coupling/scene/scene.hpp"
#include "coupling/transfer/airborne.hpp"

namespace couloir {

class PlanesModel;

class FlowSide {
 public:
  FlowSide(const Scene&, const ReferenceSurface&, int threads, const Ranks& = {});

  FlowModel& model() { return *model_; }
  Solver& solver() { return *solver_; }             // of the coupled mode, whose scenes are central upwind
  Airborne* airborne() { return airborne_.get(); }  // null: nothing flies (coupling/plan/effects.cpp says when)
  const std::vector<double>& bed() const { return bed_; }
  double density() const { return density_; }            // [kg/m3]
  double initial_mass() const { return initial_mass_; }  // [kg]

  void advance_to(double t);            // [s] flow and flights; counts CPU
  double cpu() const { return cpu_; }   // [s]
  std::vector<PartCost> costs() const;  // together cpu()

  // Takes up the other measures of force; zones: the cells that will be covered. report() then fills them in.
  const std::vector<ForceMeasure>& measure(const Scene&, const ReferenceSurface&, const std::vector<CellBox>& zones);

  // Ledger entries of the solver since the last call: mass state, momentum terms, counters.
  void report(WindowReport&);
  double momentum() const;                                       // [N s] along x, present, with what flies
  double reported_momentum() const { return momentum_before_; }  // [N s] the same, as the last report found it
  // Cells were covered: what they held is no storage of the next report.
  void forget_covered() { momentum_before_ = momentum(); }
  ObstacleForce force(int obstacle, double window);  // mean since the last call for this obstacle
  // [kg] since the start, through the plane of its middle; where it is made of planes, over its upper edges.
  double overtopped(int obstacle) const;
  int planes_obstacle() const { return planes_obstacle_; }  // number of the one that is made of planes; -1: none

  FrameView frame();

  // With all ranks together; into what was built from the same scene.
  void state(Archive&);

 private:
  // The top of an obstacle: where, in this rectangle [m], its body is highest.
  struct Top {
    double x0, x1, y0, y1;
    std::function<double(double x, double y)> height;  // [m] 0 beside it
  };
  void lay_bed(const StepBed&, int levels);
  void make_airborne(const Scene&, const ReferenceSurface&);
  static Top top_of(const ObstacleSpec&, int id, const StepBed&);
  double depth_on(const Top&) const;  // [m] the greatest, in the finest cells
  int add_gauge(const ObstacleSpec&);
  std::vector<LevelCells> levels() const;
  void gather_blocks();
  void gather_planes();

  double density_;
  std::unique_ptr<FlowModel> model_;
  Solver* solver_ = nullptr;  // the same, where the scheme is central upwind and no obstacle is made of planes
  PlanesModel* planes_ = nullptr;
  int planes_obstacle_ = -1;
  double least_climbing_ = 0;  // [m] thinner material does not count as having climbed
  std::vector<PlaneView> plane_views_;
  BlocksView blocks_;
  std::vector<double> bed_;
  std::vector<int> gauge_;                      // by obstacle
  std::vector<std::array<double, 2>> impulse_;  // by obstacle, at the last call
  std::vector<Top> tops_;                       // by obstacle
  std::optional<ForceMeasures> measures_;
  std::unique_ptr<Airborne> airborne_;
  std::vector<double> h_, hu_, hv_;
  PartTimes parts() const;    // [s] of cpu_ without the flights
  PartTimes parts_before_{};  // of runs that this one goes on from
  double cpu_flights_ = 0;
  double initial_mass_ = 0, boundary_mass_ = 0, inflow_mass_ = 0, copied_mass_ = 0, momentum_before_ = 0, cpu_ = 0;
};

}  // namespace couloir
