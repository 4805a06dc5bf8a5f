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

#include "continuum/boundary/side.hpp"
#include "continuum/flow/closure.hpp"
#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/grid.hpp"
#include "continuum/scheme/budget.hpp"
#include "continuum/scheme/limiter.hpp"
#include "continuum/terrain/reference_surface.hpp"
#include "continuum/terrain/step_bed.hpp"

namespace couloir {

struct SolverSettings {
  Grid grid;
  double gravity = 9.81;  // [m/s2]
  Closure closure;        // earth pressure, basal friction, curvature on or off
  Limiter limiter = Limiter::minmod;
  std::array<Side, 4> sides{};  // by SideName: upstream, downstream, left (y low), right (y high)
  double cfl = 0.45;            // at most 0.5: the positivity bound of the scheme
  double dry_depth = 1e-7;      // [m] below it a cell carries mass but no momentum
  int block = 32;               // cells along a block's edge
  int threads = 1;
};

class Solver {
 public:
  Solver(const SolverSettings&, const ReferenceSurface&, const StepBed&);
  ~Solver();
  Solver(Solver&&) noexcept;

  const Grid& grid() const;
  double time() const;  // [s]
  std::int64_t steps() const;
  std::int64_t cell_updates() const;  // active cells times stages

  void set(const std::function<FlowState(double x, double y)>&);  // at cell centres
  void set(int i, int j, const FlowState&);
  FlowState at(int i, int j) const;
  void gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const;  // [j * nx + i]
  double volume() const;                                     // [m3] of the cells that are not covered; summed in a fixed order
  std::array<double, 2> momentum() const;                    // [m4/s] of the cells that are not covered
  double min_depth() const;                                  // [m] least depth met so far in an active cell, before any clipping
  double max_speed() const;                                  // [m/s]
  std::array<double, 2> earth_pressure(int i, int j) const;  // K_x, K_y of the cell's present state

  double stable_dt() const;  // [s] for the present state
  // One step of at most dt; throws NumericsError when the state is not finite, naming the cell.
  void step(double dt);
  void advance_to(double t_end);  // as many stable steps as it takes, the last one ends at t_end

  // The covered zone: cells whose material is not the solver's. They are not stepped; their neighbours see the state given
  // here in reconstructions; every face of the rim passes exactly the imposed flux (limited so that no cell is emptied).
  void cover(const CellBox&);  // one box; the cells keep their last state as the covered state
  void uncover();              // all covered cells become active with their present state
  const CellBox& covered() const;
  void set_covered(int i, int j, const FlowState&);
  // Rim faces: side by SideName of the zone (upstream face: x = x of i0), k counts cells along the face from the low end.
  void impose(SideName, int k, const FaceFlux&);
  // What really passed since reset_rim(), integrated over time, per unit width: [m2], [m3/s].
  FaceFlux passed(SideName, int k) const;
  void reset_rim();

  // Impulse per density on obstacle `id` of the StepBed since the start [m4/s]; times bulk density and cos-free: N s.
  std::array<double, 2> obstacle_impulse(int id) const;
  // Volume that crossed the x-face at i (between cells i-1 and i) for rows [j0, j1) since the start, downslope positive [m3].
  int add_gauge(int i, int j0, int j1);
  double gauge(int id) const;

  const Budget& budget() const;
  void reset_budget();

  // The whole state as bytes: restore() continues to the same bits.
  std::vector<std::uint8_t> checkpoint() const;
  void restore(const std::vector<std::uint8_t>&);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace couloir
