#pragma once
// Inside NocSolver: the two lattices and the order of a step.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "continuum/noc/control_box.hpp"
#include "continuum/noc/lattice.hpp"
#include "continuum/noc/noc_solver.hpp"
#include "continuum/noc/share.hpp"

namespace couloir {

struct NocSolver::Impl {
  using Point = noc::Point;
  using Lattice = noc::Lattice;

  struct Gauge {
    int i, j0, j1;
    double volume;
  };
  // One of the four shares of a corner, as the corner sees it; beyond a wall it is the mirror image of one inside.
  struct Giver {
    const Point* p;
    double cx, cy;          // which of the giver's quadrants
    double flip_x, flip_y;  // -1: momentum turned
    int k, l;               // the quadrant's quarter point
    bool inside;            // of the domain
    bool locked;
  };
  // The part of it that depends on the column (row) alone.
  struct Line {
    int index;
    double corner, flip;
    bool inside;
    int outflow = -1, inflow = -1;  // side
  };
  // What a point gets from its four quadrants, [a][b]: a = 0 the lower one in x, b in y.
  struct Gathered {
    FlowState share[2][2];
    noc::Push push[2][2];
    bool inside[2][2] = {};  // of the domain; of corners only
    FlowState sum;           // of the shares, with the pushes of gravity and bed
    noc::Push all;
    double reach = 0;
    bool held = true;
    void add_up();
  };
  struct RowSums {  // per area of a cell
    Budget budget;
    double min_depth = std::numeric_limits<double>::infinity();
    bool finite = true;
    void note(double h, double hu, double hv) {
      const double all = h + hu + hv;
      min_depth = std::min(min_depth, h);
      finite = finite && all - all == 0;
    }
  };
  struct Settled {
    double hu = 0, hv = 0;
    std::array<double, 2> friction{}, cutoff{};  // what they took, with its sign
  };

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
  CellBox window(int margin) const;       // the wet cells and so many around them
  bool half_step_to_corners(double tau);  // false: the CFL bound (3.22) would break on the corners
  void half_step_to_centres(double tau);

  // Rest.
  void find_locked(const CellBox& cells);
  bool locked(int i, int j) const;

  // Positivity.
  void limit_corners(const CellBox& corners);
  void limit_centres(const CellBox& cells);
  void limit(Point&);
  void limit_corner(int i, int j);

  Line line(int corner, int which, int cells, int low_side) const;
  Giver giver(int i, int j, int a, int b) const;
  void make_inflow(double tau);
  Gathered gather_corner(int i, int j, double tau) const;
  Gathered gather_centre(int i, int j, double tau) const;
  void update_corner(int i, int j, double tau, RowSums&);
  void update_centre(int i, int j, double tau, RowSums&);
  // Friction, film and speed bound on the momentum that the other terms would give.
  Settled settle(const Gathered&) const;
  static std::array<double, 2> friction_inside(const Settled&, const Gathered&, const noc::Push& in, double portion);
  bool on_side(int i, int j) const;  // a corner on a side that is not periodic
  // What came in through a corner on a side; where two sides meet each gets what is normal to it.
  void book_side(int i, int j, double x, double y, Budget&) const;
  bool on_open_side(int i, int j) const;                     // outflow or inflow
  bool counted(int i, int j) const;                          // false: the periodic twin of another corner
  double share_to_centre(int i, int j, int a, int b) const;  // depth that corner (i + a, j + b) gives back to cell (i, j)
  double gain(int i, int j, int a, int b) const;  // depth that cell (i, j) gets from its corner (a, b) beyond what it gave
  void count_sides(const CellBox& corners);
  void count_obstacles(const Lattice& givers, const CellBox& receivers, double tau);
  void count_gauges(const CellBox& corners);
  void count_boxes(const CellBox& cells, double tau);  // after both half steps are known, before the centres change
  void count_box_corner(const CellBox& box, int i, int j, double tau, noc::BoxTerms&) const;
  void count_box_centre(const CellBox& box, int i, int j, double tau, noc::BoxTerms&) const;
  std::array<double, 2> momentum_in(const CellBox&) const;  // [m4/s]
  void find_wet(const CellBox& cells);
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
  std::vector<Line> lines_x, lines_y;  // [2 * corner + which]
  std::array<Point, 4> inflow;         // what stands beyond an inflow side
  std::array<std::vector<double>, 4> inflow_entered;  // [m] at each corner of an inflow side, in this step
  std::array<std::vector<double>, 4> inflow_owed;     // [m] to each cell of it, still
  CellBox wet;                         // all cells that reach the dry depth lie in it
  bool scan = true;                    // wet is out of date
  std::optional<double> rate;          // of the present state; empty: the state has changed
  CellBox corner_box;                  // of the half step under way
  std::vector<RowSums> first;          // of the half step to the corners, booked when the pair stands

  std::vector<std::array<double, 2>> impulse;
  std::vector<std::vector<char>> own_push;  // by obstacle and its quarter points: 1: counts for the impulse; empty: all do
  std::vector<Gauge> gauges;
  std::vector<noc::ControlBox> boxes;
  Budget budget;
  double time = 0;
  std::int64_t steps = 0, cell_updates = 0, limited_count = 0;
  double min_depth = 0;
  bool min_depth_met = false;
};

}  // namespace couloir
