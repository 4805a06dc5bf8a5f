#pragma once
// A slope with one cuboid made of five additional planes (the dissertation's chapter 6) instead of a bed elevation or a step.
//
//   step   edges: the flux through every face from the present states (edge_flux.hpp), limited to what the cells hold
//          the slope steps with its side of them; the planes step with what really passed
//
// Mass over slope and planes is kept to round-off; what the edges turn is their reaction. What comes over the upper edges is
// counted: beyond them the method says nothing true (docs/decisions/0008-planes-exchange-fluxes.md).

#include <memory>

#include "continuum/flow_model.hpp"
#include "continuum/planes/cuboid.hpp"
#include "continuum/terrain/reference_surface.hpp"
#include "continuum/terrain/step_bed.hpp"

namespace couloir {

class PlanesModel final : public FlowModel {
 public:
  // `cuboid`: number of the obstacle of the bed that is made of planes; the others are steps. eta in [0, 1]: share of the
  // velocity that the concave edges between slope and planes pass on. The footprint is that of the cells whose centres it holds,
  // the height is exact. Throws std::invalid_argument where the footprint holds no cell, a side of it is periodic, or eta is out
  // of bounds.
  PlanesModel(const SolverSettings&, const ReferenceSurface&, const StepBed&, int cuboid, double eta);
  ~PlanesModel() override;
  PlanesModel(PlanesModel&&) noexcept;

  const Grid& grid() const override;
  double time() const override;
  std::int64_t steps() const override;
  PartTimes part_times() const override;
  std::int64_t cell_updates() const override;

  // Nothing is set on the footprint; by cell, the footprint is the top plane.
  void set(const std::function<FlowState(double x, double y)>&) override;
  void set(int i, int j, const FlowState&) override;
  FlowState at(int i, int j) const override;
  void gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const override;
  double volume() const override;                   // of slope and planes
  std::array<double, 2> momentum() const override;  // along x and y, of slope and planes
  double min_depth() const override;
  double max_speed() const override;

  double stable_dt() const override;
  void step(double dt) override;

  // Of the cuboid: what the edges of its foot take, the weight on its front and the friction on its planes. The turning about its
  // own convex edges is not part of it: real material leaves them and pulls at nothing. The budget has that too.
  std::array<double, 2> obstacle_impulse(int id) const override;
  // Round the cuboid: slope and planes together. It sees the convex edges' turning too, so it is obstacle_impulse() without it
  // only where nothing turns.
  int add_control_box(const CellBox&) override;
  std::array<double, 2> control_box_impulse(int id) const override;
  int add_gauge(int i, int j0, int j1) override;  // on the slope; faces under the cuboid count nothing
  double gauge(int id) const override;

  const Budget& budget() const override;
  void reset_budget() override;

  std::vector<std::uint8_t> checkpoint() const override;
  void restore(const std::vector<std::uint8_t>&) override;

  const CellBox& footprint() const;
  const PlaneFlow& plane(PlaneName) const;  // not slope, not none
  void set_plane(PlaneName, int i, int j, const FlowState&);
  double overflow() const;                   // [m3] that came over the upper edges onto the top since the start
  double climbed(double least_depth) const;  // [m] top of the front's highest cell that is at least that deep; 0: none
  double heap() const;                       // [m] greatest depth on the slope along the foot of the front

 private:
  void set_time(double t) override;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace couloir
