#pragma once
// Inside the solver: the blocks, their states, and the order of a step.

#include <cstdint>
#include <optional>
#include <vector>

#include "continuum/boundary/covered_zone.hpp"
#include "continuum/boundary/ghosts.hpp"
#include "continuum/mesh/mesh.hpp"
#include "continuum/scheme/kernels.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/stage.hpp"
#include "continuum/solver.hpp"

namespace couloir {

struct Solver::Impl {
  struct Gauge {
    int i, j0, j1;
    double volume;
  };

  struct ControlBox {
    CellBox cells;
    std::array<double, 2> before;  // momentum when it was added [m4/s]
    BoxTerms terms;
  };

  Impl(const SolverSettings&, const ReferenceSurface&, const StepBed&);

  // The step.
  void step(double dt);
  double stable_dt();
  void refresh();                      // choose blocks, fill ghosts, find the signal rate, if the state has changed
  void choose_blocks(bool corrector);  // those with material in them or beside them
  void fill_ghosts(double at, Moment = Moment::after);  // with the inflows of this time [s]
  void run(StageName, double dt);
  bool negative() const;  // some depth of this step fell below zero
  void go_back();         // to the start of the step
  void collect_tallies();
  void count_zone(double dt);
  // These throw NumericsError, naming place and time.
  void check_finite() const;
  [[noreturn]] void fail_negative(double dt) const;
  [[noreturn]] void fail_step(double dt) const;

  // The covered zone.
  void cover(const CellBox&);
  void uncover();
  void mark_open();
  void lay_rim();

  void lay_gauge(int id);
  void lay_box(int id);
  std::array<double, 2> momentum_in(const CellBox&) const;  // [m4/s]
  void put(int i, int j, const FlowState&);
  FlowState get(int i, int j) const;
  // Shares of the passive state along x and y; 0 where the closure is hydraulic.
  void put_passive(int i, int j, const std::array<double, 2>&);
  std::array<double, 2> passive(int i, int j) const;
  template <class F>
  void for_open_cells(F&& f) const;  // f(fields, cell) in a fixed order

  SolverSettings settings;
  Parameters parameters;
  const Kernels& kernels = couloir::kernels();
  Mesh mesh;
  Ghosts ghosts;
  std::vector<BlockState> states;
  std::vector<BlockFaces> faces;
  std::vector<Scratch> scratch;  // by thread
  std::vector<int> chosen;       // blocks to step
  struct StageRecord {
    std::vector<int> blocks;
    std::vector<Tally> tallies;  // by number of the block
  };
  std::array<StageRecord, 2> record;  // of the two stages, booked when the step stands
  std::vector<char> inflow_block;
  CoveredZone zone;
  std::vector<std::array<double, 2>> impulse;
  std::vector<Gauge> gauges;
  std::vector<ControlBox> boxes;
  Budget budget;
  double steepest = 0;  // how fast slope and bed speed the flow up [1/s2]
  double time = 0;
  double strained = 0;  // [s] of the last step, for which the earth pressure has still to follow
  std::int64_t steps = 0, cell_updates = 0;
  double min_depth = 0;
  bool min_depth_met = false;
  std::optional<double> rate;  // of the present state; empty: the state has changed
};

template <class F>
void Solver::Impl::for_open_cells(F&& f) const {
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Block& b = mesh.blocks()[k];
    for (int j = 0; j < b.ny; ++j) {
      for (int i = 0; i < b.nx; ++i) {
        const int c = b.at(i, j);
        if (states[k].open[c] != 0) f(states[k].now, c);
      }
    }
  }
}

}  // namespace couloir
