#pragma once
// Inside the solver: the blocks, their states, and the order of a step.
//
//   solver_impl.cpp     blocks, gauges, boxes; cells by their place       solver_zone.cpp     the covered zones
//   solver_step.cpp     a step, level by level                            solver_refine.cpp   another mesh
//   solver_errors.cpp   what ends a run, with its place                   solver_ranks.cpp    what the ranks tell each other
//   solver_read.cpp     refined cells by their place

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "continuum/boundary/covered_zones.hpp"
#include "continuum/boundary/ghosts.hpp"
#include "continuum/halo.hpp"
#include "continuum/mesh/forest.hpp"
#include "continuum/mesh/mesh.hpp"
#include "continuum/mesh/wishes.hpp"
#include "continuum/scheme/counted.hpp"
#include "continuum/scheme/kernels.hpp"
#include "continuum/scheme/laps.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/stage.hpp"
#include "continuum/solver.hpp"

namespace couloir {

struct Solver::Impl {
  struct ControlBox {
    CellBox cells;
    std::array<double, 2> before;  // momentum when it was added [m4/s]
    BoxTerms terms;
  };

  // The blocks of one size of cells; each level takes two steps in one of the level before.
  struct Level {
    std::vector<int> blocks, chosen, own;  // all; those to step; those of them that this rank steps
    double strained = 0;                   // [s] of its last step, for which the earth pressure has still to follow
  };

  // What a block held before the whole step, where its own start is a later one.
  struct Before {
    Fields q;
    std::vector<double> passive_x, passive_y;
  };

  Impl(const SolverSettings&, const ReferenceSurface&, const StepBed&);

  // The step.
  void step(double dt);
  double stable_dt();
  void refresh();  // begin all levels, find the signal rate, if the state has changed
  // Chooses blocks, fills ghosts and lets the earth pressure follow, on this level and all finer ones; share: of the coarser
  // level's step that has passed. Returns the signal rate of each of these levels.
  std::vector<double> begin(int level, double at, double share);
  // One step of a level and two of the next, and so on; false: it was too long for some cell.
  bool advance(int level, double from, double to, double dt, double share);
  void look_ahead(int level, double from, double to, double dt);
  void choose(int level, bool corrector);  // blocks with material in them or beside them
  void set_inflow(double at, Moment = Moment::after);
  void set_inflow(double from, double to);  // at the first of these times, and the mean discharge between them
  // Of the blocks that step, and of one; shares: those of the passive state, too.
  void fill_ghosts(int level, double share, bool shares);
  void fill_block(int block, double share, bool shares);
  void look(int level, const std::vector<int>& blocks);
  bool run(int level, StageName, double dt);  // false: some depth fell below zero
  void go_back();                             // to the start of the step
  void collect_tallies();
  std::vector<Laps*> laps();  // of all threads
  void count_zones(double dt);
  // These throw NumericsError, naming place and time.
  void check_finite() const;
  [[noreturn]] void fail_negative(double dt) const;
  [[noreturn]] void fail_step(double dt) const;

  // The ranks.
  bool mine(int block) const { return owned.empty() || owned[block] != 0; }
  void deal();           // blocks to ranks, by what they cost now
  void share_tallies();  // all ranks have all
  void sync();           // all ranks have all cells, ghosts apart

  // The mesh.
  void fill_all_ghosts();
  void start_empty();  // on the mesh as it is
  void lay_blocks();   // all that goes with the mesh's blocks but their states
  void size(BlockState&, const Block&) const;
  void lay_level_faces();
  void take_leaves(const std::vector<Leaf>&);  // an empty mesh of these blocks
  void refine_boxes();                         // as the settings' boxes want
  bool adapt();                                // as the state wants; false: the mesh is right
  void wish_by_state(std::vector<Wish>&) const;
  void become(const std::vector<Leaf>&);
  void take_from_parent(int block, const Block& parent, const BlockState& held);
  void take_from_children(int block, const Mesh& old, const std::vector<BlockState>& held);

  // The covered zones.
  void lay_zones();  // after zones have come, moved or gone
  void mark_open();
  void lay_rims();

  void lay_gauge(int id);
  void lay_box(int id);
  std::array<double, 2> momentum() const;                           // [m4/s] of the open cells
  double open_sum(int block, const std::vector<double>& of) const;  // over its open cells, times their area
  std::array<double, 2> momentum_in(const CellBox&) const;          // [m4/s]
  // Of a cell of the coarsest grid: put() gives all finer ones in it the same, get() takes their mean.
  void put(int i, int j, const FlowState&);
  FlowState get(int i, int j) const;
  void add(int i, int j, const FlowState&);  // to all finer ones in it
  void put_in(int block, int cell, const FlowState&);
  std::vector<FlowState> along(SideName, int i, int j) const;  // of the finer ones on that side of it, from the low end
  // Of a cell of this level, or the mean of the finer ones in it; none where the cells are coarser.
  std::optional<FlowState> state_at(int level, int i, int j) const;
  // Shares of the passive state along x and y; 0 where the closure is hydraulic.
  std::array<double, 2> passive(int i, int j) const;
  void set_active(int i, int j);  // the earth pressure
  template <class F>
  void for_cells_in(int i, int j, F&& f) const;  // f(block, cell) of those in a cell of the coarsest grid
  template <class F>
  void for_cells(F&& f) const;  // f(block, cell), number and index of each cell in a fixed order

  SolverSettings settings;
  Parameters parameters;
  const Kernels& kernels = couloir::kernels();
  std::unique_ptr<Forest> forest;  // none: the mesh is uniform and stays so
  Mesh mesh;
  std::optional<Ghosts> ghosts;
  std::vector<BlockState> states;
  std::vector<BlockFaces> faces;
  std::vector<LevelFluxes> across;  // from finer to coarser, by coarser block
  std::vector<char> inflow_block, beside_finer;
  std::vector<Level> levels;
  std::vector<Scratch> scratch;       // by thread
  std::vector<Tally> tallies;         // of this step, by block
  std::vector<char> touched;          // whether there is one
  std::vector<Before> before;         // of finer blocks, where touched
  std::vector<WetPlaces> wet_before;  // of all blocks, at the whole step's start
  std::vector<char> owned;            // by this rank; empty: all are
  std::vector<char> changed;          // since all ranks had them
  Halo halo;
  CoveredZones zones;
  std::vector<std::array<double, 2>> impulse;
  std::vector<std::array<double, 4>> obstacle_boxes;  // [m] x0, x1, y0, y1
  std::vector<Gauge> gauges;
  std::vector<ControlBox> boxes;
  Budget budget;
  double steepest = 0;  // how fast slope and bed speed the flow up [1/s2]
  double time = 0;
  std::int64_t steps = 0, cell_updates = 0;
  double min_depth = 0;
  bool min_depth_met = false;
  StepTimer timer;
  std::optional<double> rate;  // of the present state; empty: the state has changed
};

template <class F>
void Solver::Impl::for_cells(F&& f) const {
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Block& b = mesh.blocks()[k];
    for (int j = 0; j < b.ny; ++j) {
      for (int i = 0; i < b.nx; ++i) f(static_cast<int>(k), b.at(i, j));
    }
  }
}

}  // namespace couloir
