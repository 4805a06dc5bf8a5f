#pragma once
// What a run needs of a continuum solver, whatever its scheme: settings in, step, state out.
//
//   Solver (solver.hpp)              central upwind; has the covered zone of the coupled mode
//   NocSolver (noc/noc_solver.hpp)   the staggered non-oscillatory central scheme
//   NestedNoc (noc/nested_noc.hpp)   the same on nested, locally refined grids

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "continuum/boundary/side.hpp"
#include "continuum/flow/closure.hpp"
#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/grid.hpp"
#include "continuum/mesh/ranks.hpp"
#include "continuum/mesh/refinement.hpp"
#include "continuum/scheme/budget.hpp"
#include "continuum/scheme/limiter.hpp"
#include "continuum/scheme/step_parts.hpp"

namespace couloir {

struct SolverSettings {
  Grid grid;
  double gravity = 9.81;  // [m/s2]
  Closure closure;        // earth pressure, basal friction, curvature on or off
  Limiter limiter = Limiter::minmod;
  std::array<Side, 4> sides{};  // by SideName: upstream, downstream, left (y low), right (y high)
  double cfl = 0.45;            // at most 0.5: the bound of both schemes
  double dry_depth = 1e-7;      // [m] below it a cell carries mass but no momentum
  int block = 32;               // cells along a block's edge; central upwind only
  int threads = 1;
  Refinement refinement;  // empty: one uniform grid
  Ranks ranks{};          // the processes that share the run; central_upwind only
};

// A rectangle of cells of one size: local (0, 0) is cell (i0, j0) of the grid halved `level` times.
struct BlockPlace {
  int level = 0, i0 = 0, j0 = 0, nx = 0, ny = 0;
  bool operator==(const BlockPlace&) const = default;
};

class FlowModel {
 public:
  virtual ~FlowModel() = default;

  virtual const Grid& grid() const = 0;
  virtual double time() const = 0;  // [s]
  virtual std::int64_t steps() const = 0;
  virtual std::int64_t cell_updates() const = 0;  // active cells times stages
  virtual PartTimes part_times() const = 0;       // [s] of the clock, of all steps of this object

  virtual void set(const std::function<FlowState(double x, double y)>&) = 0;  // at cell centres
  virtual void set(int i, int j, const FlowState&) = 0;
  virtual FlowState at(int i, int j) const = 0;
  virtual void gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const = 0;  // [j * nx + i]
  // Where cells are refined: the blocks, finest where several lie on one another, and what one holds, [j * nx + i]. Else none.
  virtual std::vector<BlockPlace> blocks() const { return {}; }
  virtual void gather_block(int, std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const {
    h.clear(), hu.clear(), hv.clear();
  }
  // The finest cells at their centres, where those lie in the rectangle, row by row; along an axis on which none does, those that
  // hold its middle. Nearest to the domain where it lies beyond.
  struct Sample {
    double x, y;
    FlowState q;
  };
  virtual void for_finest(double x0, double x1, double y0, double y1, const std::function<void(const Sample&)>&) const;
  // Bilinear between the four nearest centres of the finest grid that holds the point; beyond the last centres as on them.
  virtual FlowState interpolated(double x, double y) const;
  virtual double volume() const = 0;                   // [m3] summed in a fixed order
  virtual std::array<double, 2> momentum() const = 0;  // [m4/s]
  virtual double min_depth() const = 0;                // [m] least depth met so far in an active cell, before any clipping
  virtual double max_speed() const = 0;                // [m/s]

  virtual double stable_dt() const = 0;  // [s] for the present state
  // One step of at most dt; throws NumericsError, naming time and place, when the state is not finite or a cell would be
  // overdrawn however short the step.
  virtual void step(double dt) = 0;
  // As many stable steps as it takes, the last one ends at t_end; throws NumericsError when the flow has become so fast that they
  // would be more than 1e10.
  void advance_to(double t_end);

  // Impulse per density on obstacle `id` since the start [m4/s]; times bulk density: N s.
  virtual std::array<double, 2> obstacle_impulse(int id) const = 0;
  // A control volume: cells whose momentum is booked from now on, so add it after the state is set. The impulse per density that
  // bodies in it took since then [m4/s], from outside: what came through its faces, by weight and by friction, less the change
  // of its momentum. Bodies must not reach over its faces. Throws std::out_of_range where the box is empty or leaves the grid.
  virtual int add_control_box(const CellBox&) = 0;
  virtual std::array<double, 2> control_box_impulse(int id) const = 0;

  // Volume that crossed the x-face at i (between cells i-1 and i) for rows [j0, j1) since the start, downslope positive [m3].
  virtual int add_gauge(int i, int j0, int j1) = 0;
  virtual double gauge(int id) const = 0;

  virtual const Budget& budget() const = 0;
  virtual void reset_budget() = 0;

  // The whole state as bytes: restore() continues to the same bits.
  virtual std::vector<std::uint8_t> checkpoint() const = 0;
  virtual void restore(const std::vector<std::uint8_t>&) = 0;

 protected:
  FlowModel() = default;
  FlowModel(const FlowModel&) = default;
  FlowModel& operator=(const FlowModel&) = default;
  [[noreturn]] virtual void fail_step(double dt) const;  // NumericsError: stable steps of dt no longer get anywhere
  virtual void set_time(double t) = 0;                   // the end of advance_to, without round-off
};

}  // namespace couloir
