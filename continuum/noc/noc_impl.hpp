#pragma once
// Inside NocSolver: the two lattices and the order of a step.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "continuum/noc/control_box.hpp"
#include "continuum/noc/lattice.hpp"
#include "continuum/noc/noc_solver.hpp"
#include "continuum/noc/receive.hpp"
#include "continuum/noc/region.hpp"
#include "continuum/noc/share.hpp"
#include "continuum/scheme/counted.hpp"
#include "continuum/scheme/laps.hpp"

namespace couloir {

struct NocSolver::Impl {
  using Point = noc::Point;
  using Lattice = noc::Lattice;

  // One of the four shares of a corner, as the corner sees it; beyond a wall it is the mirror image of one inside.
  struct Giver {
    Point p;
    int source;             // index of the centre; -1: an inflow
    double cx, cy;          // which of the giver's quadrants
    double flip_x, flip_y;  // -1: momentum turned
    int k, l;               // the quadrant's quarter point
    bool inside;            // of the domain
    double locked;
  };
  // The part of it that depends on the column (row) alone.
  struct Line {
    int index;
    double corner, flip;
    bool inside;
    int outflow = -1, inflow = -1;  // side
  };
  // What a corner gets from its four quadrants, [a][b]: a = 0 the lower one in x, b in y.
  struct Gathered {
    noc::Part part[2][2], all;
    bool inside[2][2] = {};  // of the domain
    double reach = 0, held = 1;
    void add_up();
    double hu() const { return all.hu + all.x; }  // that all terms but friction give
    double hv() const { return all.hv + all.y; }
  };
  using RowSums = noc::RowSums;
  using Settled = noc::Settled;
  using Region = noc::Region;

  Impl(const SolverSettings&, const ReferenceSurface&, const NocBed&, const NocSettings&);

  void step(double dt);
  double stable_dt();
  void refresh();              // window, ghosts, state, signal rate, where the state has changed
  void refresh_state();        // ghosts, state and signal rate
  bool set_inflow(double at);  // for the time given
  void lay_lines();
  void wet_inflow();
  void put_inflow_right(double dt);
  FlowState inflow_change(int side, int k, int cell, double dt);
  int inflows_at(int i, int j) const;  // inflow sides of a cell
  void add_inflow(int cell, const FlowState& change);
  void lay_regions();                     // around the wet cells
  bool half_step_to_corners(double tau);  // false: the CFL bound (3.22) would break on the corners
  void half_step_to_centres(double tau);
  noc::Drag drag() const;
  bool periodic(int axis) const { return settings.sides[2 * axis].kind == Side::Kind::periodic; }
  // Of row j of these corners: those that inner loops can take; the others but for the upper ones of periodic twins.
  std::pair<int, int> inner(const Region& corners, int j) const;
  template <class F>
  void for_outer(const Region& region, int j, F&& f) const {
    const auto [low, high] = inner(region, j);
    const int last = settings.grid.nx;
    if (periodic(1) && j == settings.grid.ny) return;
    for (int i = region.begin(j); i < std::min(low, region.end(j)); ++i) f(i);
    for (int i = std::max(high, region.begin(j)); i < region.end(j); ++i) {
      if (!(periodic(0) && i == last)) f(i);
    }
  }
  void copy_twins(int j);  // of row j of the corners

  // Rest.
  void find_locked();
  bool locked(int i, int j) const;

  // Positivity.
  void limit_corners();
  void limit_centres();
  double depth_at_corner(int i, int j) const;  // that it would get
  double depth_at_centre(int i, int j) const;
  void limit(Lattice&, int point);
  void limit_corner(int i, int j);

  Line line(int corner, int which, int cells, int low_side) const;
  Giver giver(int i, int j, int a, int b) const;
  void make_inflow(double tau);
  Gathered gather_corner(int i, int j, double tau) const;
  void update_corner(int i, int j, double tau, RowSums&);
  void book_centre(int i, int j, RowSums&) const;  // what its corners on a side give back to a cell
  noc::Ground ground(int k, int l) const;
  Settled settle(const Gathered& got) const { return noc::settle(got.all, got.reach, got.held, drag()); }
  static std::array<double, 2> friction_inside(const Settled&, const Gathered&, const noc::Part& in, double portion);
  bool on_side(int i, int j) const;  // a corner on a side that is not periodic
  // What came in through a corner on a side; where two sides meet each gets what is normal to it.
  void book_side(int i, int j, double x, double y, Budget&) const;
  bool on_open_side(int i, int j) const;                     // outflow or inflow
  double share_to_centre(int i, int j, int a, int b) const;  // depth that corner (i + a, j + b) gives back to cell (i, j)
  double gain(int i, int j, int a, int b) const;  // depth that cell (i, j) gets from its corner (a, b) beyond what it gave
  void count_sides();
  void count_obstacles(const Lattice& givers, const Region& receivers, double tau);
  void count_gauges();
  // To corners: before the centres change; to centres: after that.
  enum class HalfStep { to_corners, to_centres };
  void count_boxes(HalfStep, double tau);
  void count_box_corner(const CellBox& box, int i, int j, double tau, noc::BoxTerms&) const;
  void count_box_centre(const CellBox& box, int i, int j, double tau, noc::BoxTerms&) const;
  std::array<double, 2> momentum_in(const CellBox&) const;  // [m4/s]
  void find_wet();
  void collect(const std::vector<RowSums>&);
  void check_finite() const;  // throws NumericsError
  void replace(const CellBox& cells, const std::function<FlowState(int i, int j)>& state);
  void count_forces_in(const CellBox& cells, const std::vector<CellBox>& others);
  void put(int i, int j, const FlowState&);
  FlowState get(int i, int j) const;

  SolverSettings settings;    // its inflow sides: as they are now
  std::array<Side, 4> sides;  // as given
  noc::Terrain terrain;
  Lattice centres, corners;
  std::vector<Line> lines_x, lines_y;                 // [2 * corner + which]
  std::array<Point, 4> inflow;                        // what stands beyond an inflow side
  std::array<std::vector<double>, 4> inflow_entered;  // [m] at each corner of an inflow side, in this step
  std::array<std::vector<double>, 4> inflow_owed;     // [m] to each cell of it, still
  Region wet;                                         // all cells that reach the dry depth
  Region near, around;                                // within one cell of them: those that change; within four: those that give
  Region near_corners, corner_region;  // of the cells that change; of those within three, whose corners have a state
  bool scan = true;                    // wet is out of date
  std::optional<double> rate;          // of the present state; empty: the state has changed
  std::vector<RowSums> first;          // of the half step to the corners, booked when the pair stands

  std::vector<std::array<double, 2>> impulse;
  std::vector<std::vector<char>> own_push;  // by obstacle and its quarter points: 1: counts for the impulse; empty: all do
  std::vector<Gauge> gauges;
  std::vector<noc::ControlBox> boxes;
  Budget budget;
  double time = 0;
  StepTimer timer;
  std::int64_t steps = 0, cell_updates = 0, limited_count = 0;
  double min_depth = 0;
  bool min_depth_met = false;
};

}  // namespace couloir
