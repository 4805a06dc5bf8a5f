#pragma once
// The depth-averaged solver: settings in, step, state out. Savage-Hutter equations (2.87)-(2.92) in SI units,
//
//   d_t h  + d_x(hu) + d_y(hv) = 0
//   d_t hu + d_x(hu^2 + K_x g cos(zeta) h^2/2) + d_y(huv) = h s_x
//   d_t hv + d_x(huv) + d_y(hv^2 + K_y g cos(zeta) h^2/2) = h s_y
//
// on blocks of cells with ghosts. Second order (TVD, two stages), positive, exact at rest; the same bits for any number of
// threads.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "continuum/flow_model.hpp"
#include "continuum/terrain/reference_surface.hpp"
#include "continuum/terrain/step_bed.hpp"

namespace couloir {

class Solver final : public FlowModel {
 public:
  Solver(const SolverSettings&, const ReferenceSurface&, const StepBed&);
  ~Solver() override;
  Solver(Solver&&) noexcept;

  const Grid& grid() const override;
  double time() const override;
  std::int64_t steps() const override;
  std::int64_t cell_updates() const override;
  PartTimes part_times() const override;

  // Material that is set is active (mobilisation.hpp).
  void set(const std::function<FlowState(double x, double y)>&) override;
  void set(int i, int j, const FlowState&) override;
  // Material that falls into a cell from above: depth [m] and depth times velocity [m2/s], alike in all finer cells in it. What
  // stays thinner than the dry depth has no momentum (Budget::cutoff). Throws std::out_of_range where the cell is covered.
  void add(int i, int j, const FlowState&);
  // A lake: still material up to this height above the reference surface [m].
  void fill_to(double surface);
  FlowState at(int i, int j) const override;
  void gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const override;
  std::vector<BlockPlace> blocks() const override;
  void gather_block(int, std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const override;
  void for_finest(double x0, double x1, double y0, double y1, const std::function<void(const Sample&)>&) const override;
  FlowState interpolated(double x, double y) const override;
  double volume() const override;                   // [m3] of the cells that are not covered
  std::array<double, 2> momentum() const override;  // [m4/s] of the cells that are not covered
  double min_depth() const override;
  double max_speed() const override;
  FlowState at_side(int i, int j, SideName) const;           // of the finer cells along that side of the cell, their mean
  std::array<double, 2> earth_pressure(int i, int j) const;  // K_x, K_y of the cell's present state

  double stable_dt() const override;
  void step(double dt) override;

  // Covered zones: boxes of cells whose material is not the solver's. They are not stepped; their neighbours see the state given
  // here in reconstructions; every face of their rims passes exactly the imposed flux (limited so that no cell is emptied, also
  // one between two zones). Between two zones there is at least one open cell, round corners and over periodic sides too.
  // Throws std::invalid_argument. Returns the zone's id: 0, 1, ...; none is given twice.
  int cover(const CellBox&);  // the cells keep their last state as the covered state
  // It covers these cells instead, of which it may have had some: those keep their covered state, those that join them their last
  // state; those that it leaves become the solver's with their present state. Its rim starts anew: nothing imposed, nothing
  // passed.
  void move_zone(int zone, const CellBox&);
  void uncover(int zone);                  // its cells become the solver's with their present state; the id stays unused
  const CellBox& covered(int zone) const;  // empty: uncovered
  int zones() const;                       // how many ids have been given
  void set_covered(int i, int j, const FlowState&);  // of any zone
  // Rim faces: side by SideName of the zone (upstream face: x = x of i0), k counts cells along the face from the low end.
  // Of an id or a face that there is not: std::out_of_range.
  void impose(int zone, SideName, int k, const FaceFlux&);
  // What really passed since reset_rim(), integrated over time, per unit width: [m2], [m3/s].
  FaceFlux passed(int zone, SideName, int k) const;
  void reset_rim(int zone);

  // On a step of the StepBed the blocked flux at its faces, on elevation the bed's push (scheme/bed_push.hpp); friction on its
  // top is not in it.
  std::array<double, 2> obstacle_impulse(int id) const override;
  int add_control_box(const CellBox&) override;
  std::array<double, 2> control_box_impulse(int id) const override;
  int add_gauge(int i, int j0, int j1) override;
  double gauge(int id) const override;

  const Budget& budget() const override;
  void reset_budget() override;

  std::vector<std::uint8_t> checkpoint() const override;
  void restore(const std::vector<std::uint8_t>&) override;

 private:
  void set_time(double t) override;
  [[noreturn]] void fail_step(double dt) const override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace couloir
