#pragma once
// The scheme noc on nested grids, as chapter 5 of the dissertation has them: rectangles that stay where they are, each level with
// cells of half the size.
//
//   a step of a grid:   itself -> each of its patches, 2 steps of half the length -> copy their solution -> fill their rims
//
// Around a patch lies a rim of cells whose states its parent gives: bilinear in space, linear in time between the parent's states
// before and after its step. The rim is as wide as what a step reaches, so that both half steps, and the corners between them,
// see nothing else; only where depths are limited may more come through. Where a patch reaches a side of the domain it has that
// side.
//
// The parent's cells take the mean of the four finer ones. What its own fluxes at the patch's edge had brought instead is lost or
// won: plain copying is not conservative (section 5.1.2). copy_drift() and the budget's `copied` say how much.
//
// Bed and obstacles are evaluated on each level for itself. Reading functions give the base grid, whose cells hold the copied
// solution; for_finest() and interpolated() give the finest. Forces, control boxes and gauges count on the finest grid at each
// place; the budget's other terms are the base grid's own, and the difference to the pushes of the patches stands in `copied`.

#include <memory>

#include "continuum/flow_model.hpp"
#include "continuum/noc/noc_settings.hpp"
#include "continuum/noc/terrain.hpp"

namespace couloir {

class NestedNoc final : public FlowModel {
 public:
  // Patches: by settings.refinement. Throws std::invalid_argument where settings or boxes do not fit, and where it is adaptive.
  NestedNoc(const SolverSettings&, const ReferenceSurface&, const NocBed&, const NocSettings& = {});
  ~NestedNoc() override;
  NestedNoc(NestedNoc&&) noexcept;

  const Grid& grid() const override;  // of the base
  double time() const override;
  std::int64_t steps() const override;  // of the base
  PartTimes part_times() const override;
  std::int64_t cell_updates() const override;  // on all grids, rims included

  void set(const std::function<FlowState(double x, double y)>&) override;  // at the centres of each grid
  void set(int i, int j, const FlowState&) override;                       // a base cell, uniform
  FlowState at(int i, int j) const override;
  void gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const override;
  std::vector<BlockPlace> blocks() const override;  // the base grid, then the patches without their rims, parents first
  void gather_block(int, std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const override;
  void for_finest(double x0, double x1, double y0, double y1, const std::function<void(const Sample&)>&) const override;
  FlowState interpolated(double x, double y) const override;
  double volume() const override;
  std::array<double, 2> momentum() const override;
  double min_depth() const override;
  double max_speed() const override;

  double stable_dt() const override;  // [s] the least of 2^level times that of each grid
  void step(double dt) override;

  std::array<double, 2> obstacle_impulse(int id) const override;
  int add_control_box(const CellBox&) override;
  std::array<double, 2> control_box_impulse(int id) const override;
  int add_gauge(int i, int j0, int j1) override;
  double gauge(int id) const override;

  const Budget& budget() const override;
  void reset_budget() override;
  double copy_drift() const;  // [m3] that copying has brought since the start

  // The patches, parents first: cells that are no rim.
  int patches() const;
  int level(int patch) const;
  Grid patch_grid(int patch) const;
  FlowState patch_at(int patch, int i, int j) const;

  std::vector<std::uint8_t> checkpoint() const override;
  void restore(const std::vector<std::uint8_t>&) override;

 private:
  void set_time(double t) override;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace couloir
