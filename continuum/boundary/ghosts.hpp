#pragma once
// What the ghost cells of every block hold: the neighbouring block's cells, or what the domain's side makes of the cells inside.
//
//   wall      the cells inside, mirrored, normal velocity reversed
//   outflow   the last cell inside while it flows out; mirrored as at a wall while it flows in: nothing enters
//   periodic  the cells of the other end
//   inflow    the given depth and inward velocity, at the time set; a wall while nothing comes in
//
// Beside finer blocks: the mean of four cells there. Beside coarser ones: children of the cells there (mesh/level_transfer.hpp),
// between two times of theirs.

#include <array>
#include <compare>
#include <vector>

#include "continuum/boundary/side.hpp"
#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/level_transfer.hpp"
#include "continuum/mesh/mesh.hpp"

namespace couloir {

class Ghosts {
 public:
  // Throws std::invalid_argument where only one of two opposite sides is periodic or an inflow is not possible.
  Ghosts(const Mesh&, const std::array<Side, 4>& sides);

  // Terrain in the ghosts; once.
  void extend(Mesh&);
  // The time [s] at which fill() takes the inflows; before the first call: 0.
  void set_time(double time, Moment = Moment::after);
  // What the coarser cells beside one block hold now and how they slope, for fill() from now on; their ghosts must be filled.
  // mine: only those of the blocks with a flag; empty: all.
  void look(const Mesh&, const std::vector<BlockState>&, int block, double dry_depth, const std::vector<char>& mine = {});
  // By how much they change in their present step: from BlockState::start to now, where the block was stepped. What is dry at its
  // start has nothing to give yet: the finer cells would draw on what may never come.
  void look_ahead(const std::vector<BlockState>&, int block, double dry_depth, const std::vector<char>& mine = {});
  // State in the ghosts of one block, from the interiors of the others; share: of the coarser cells' step that has passed.
  void fill(std::vector<BlockState>&, int block, double share = 0) const;
  // Shares of the passive state, likewise; what flows in has that of the cells it meets.
  void fill_passive(std::vector<BlockState>&, int block) const;
  // Open or covered, in the ghosts of one block.
  void fill_open(std::vector<BlockState>&, int block) const;

  struct Copy {
    int to;          // cell of this block
    CellPlace from;  // interior cell of another block; the first of four where they are finer
  };
  // A coarser cell as the four finer ghosts in it see it.
  struct Look {
    FlowState now, change;
    CellSlopes slopes;
  };
  struct FromCoarser {
    int to;          // the first of the ghosts
    CellPlace from;  // the cell
    Look look;
    double bed;                      // of the cell
    std::array<double, 4> children;  // of the ghosts
  };
  std::vector<FromCoarser>& coarser(int block) { return plans_[block].coarser; }
  const std::vector<Copy>& finer(int block) const { return plans_[block].finer; }  // ghosts beside finer blocks
  // take(place) for each cell of other blocks from which the ghosts of one are filled.
  template <class F>
  void for_sources(int block, F&& take) const {
    const Plan& plan = plans_[block];
    for (const Run& r : plan.copies) {
      for (int n = 0; n < r.count; ++n) take(CellPlace{r.from.block, r.from.cell + n * r.from_step});
    }
    for (const Copy& c : plan.finer) {
      const int row = rows_[c.from.block];
      for (int cell : {0, 1, row, row + 1}) take(CellPlace{c.from.block, c.from.cell + cell});
    }
    for (const FromCoarser& c : plan.coarser) take(c.from);
  }
  // Blocks from which this one's ghosts take, and where.
  struct Neighbour {
    int block;
    WetPlaces sides;  // of the neighbour; two where they touch at a corner
    auto operator<=>(const Neighbour&) const = default;
  };
  const std::vector<Neighbour>& neighbours(int block) const { return plans_[block].neighbours; }

 private:
  struct Run {  // copies at even distances
    int to, to_step;
    CellPlace from;
    int from_step, count;
  };
  struct Mirror {  // a cell of this block whose momentum may turn
    int to, from;
    signed char u, v;  // 0: as it is; 2: reversed; -1, +1: reversed while it flows against this outward direction
  };
  struct Fixed {
    Mirror mirror;  // where the terrain comes from, and the state while nothing comes in
    int side;
  };
  struct Plan {  // in this order: what lies beyond the domain's sides takes from the ghosts inside
    std::vector<Run> copies;
    std::vector<Copy> finer;
    std::vector<FromCoarser> coarser;
    std::vector<Mirror> mirrors;
    std::vector<Fixed> fixed;
    std::vector<Neighbour> neighbours;
  };
  template <class F>
  void for_beyond(int block, F&& take) const;  // take(mirror) for each ghost beyond the domain's sides
  template <class F>
  void fill_plain(int block, std::vector<double>& to, F&& of) const;  // of(block): the others' values
  void plan_cell(const Mesh&, int block, int i, int j);
  static void take(const Run&, const std::vector<double>& from, std::vector<double>& to);
  void copy(int block, const Copy&);  // joins it to the run before where it goes on

  std::array<Side, 4> sides_;
  std::array<FlowState, 4> inflow_{};  // of each side, now
  std::vector<Plan> plans_;            // of each block
  std::vector<int> rows_;
};

}  // namespace couloir
