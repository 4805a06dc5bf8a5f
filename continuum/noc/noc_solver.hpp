#pragma once
// The dissertation's scheme: the staggered non-oscillatory central scheme (Nessyahu and Tadmor 1990; Jiang and Tadmor 1998) for
// (2.87)-(2.92), equations (3.2)-(3.23), on one uniform grid; nested_noc.hpp puts several into each other.
//
//   a step = two half steps:   cell centres --(3.8), (3.12)--> corners --(3.8), (3.12)--> cell centres
//
// States are set, read and recorded at the cell centres only. docs/numerics.md lists what differs from the literal scheme.

#include <memory>

#include "continuum/flow_model.hpp"
#include "continuum/noc/noc_settings.hpp"
#include "continuum/noc/terrain.hpp"

namespace couloir {

class NocSolver final : public FlowModel {
 public:
  // Throws std::invalid_argument where the settings do not fit, a CFL number above 1/2 (3.22) among them.
  NocSolver(const SolverSettings&, const ReferenceSurface&, const NocBed&, const NocSettings& = {});
  ~NocSolver() override;
  NocSolver(NocSolver&&) noexcept;

  const Grid& grid() const override;
  double time() const override;
  std::int64_t steps() const override;  // pairs of half steps
  PartTimes part_times() const override;
  std::int64_t cell_updates() const override;  // corners and centres

  void set(const std::function<FlowState(double x, double y)>&) override;
  void set(int i, int j, const FlowState&) override;
  FlowState at(int i, int j) const override;
  void gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const override;
  double volume() const override;
  std::array<double, 2> momentum() const override;
  double min_depth() const override;
  double max_speed() const override;

  double stable_dt() const override;  // [s] of the pair
  void step(double dt) override;

  // By the bed's slope, (7.1) and (7.2): the integral of g cos(zeta) h grad z_b of this obstacle.
  std::array<double, 2> obstacle_impulse(int id) const override;
  int add_control_box(const CellBox&) override;  // a bed that is no obstacle is no body
  std::array<double, 2> control_box_impulse(int id) const override;
  int add_gauge(int i, int j0, int j1) override;
  double gauge(int id) const override;

  const Budget& budget() const override;
  void reset_budget() override;
  // How often a point's slopes and fluxes were limited, so that no depth fell below zero.
  std::int64_t limited() const;

  std::vector<std::uint8_t> checkpoint() const override;
  void restore(const std::vector<std::uint8_t>&) override;

  // For nested grids. Other states for cells, which no flux brought: booked as copied, and no control box takes them for a push.
  void replace(const CellBox&, const std::function<FlowState(int i, int j)>&);
  // From now on obstacle_impulse() counts what lies in these cells and in none of the others; the budget counts all.
  void count_forces_in(const CellBox&, const std::vector<CellBox>& others);
  void set_time(double t) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace couloir
