#pragma once
// What the ghost cells of every block hold: the neighbouring block's cells, or what the domain's side makes of the cells inside.
//
//   wall      the cells inside, mirrored, normal velocity reversed
//   outflow   the last cell inside while it flows out; mirrored as at a wall while it flows in: nothing enters
//   periodic  the cells of the other end
//   inflow    the given depth and inward velocity, at the time set; a wall while nothing comes in

#include <array>
#include <vector>

#include "continuum/boundary/side.hpp"
#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/mesh.hpp"

namespace couloir {

class Ghosts {
 public:
  // Throws std::invalid_argument where only one of two opposite sides is periodic or an inflow is not possible.
  Ghosts(const Mesh&, const std::array<Side, 4>& sides);

  // Terrain in the ghosts; once.
  void extend(Mesh&) const;
  // The time [s] at which fill() takes the inflows; before the first call: 0.
  void set_time(double time, Moment = Moment::after);
  // State in the ghosts of one block, from the interiors of the others.
  void fill(std::vector<BlockState>&, int block) const;
  // Shares of the passive state, likewise; what flows in has that of the cells it meets.
  void fill_passive(std::vector<BlockState>&, int block) const;
  // Open or covered, in the ghosts of one block.
  void fill_open(std::vector<BlockState>&, int block) const;

 private:
  struct Copy {
    int to;          // cell of this block
    CellPlace from;  // interior cell of any block
  };
  struct Mirror {  // a copy whose momentum may turn
    Copy copy;
    signed char u, v;  // 0: as it is; 2: reversed; -1, +1: reversed while it flows against this outward direction
  };
  struct Fixed {
    Copy copy;  // where the terrain comes from
    int side;
    signed char u, v;  // as Mirror, while nothing comes in
  };
  struct Plan {
    std::vector<Copy> copies;
    std::vector<Mirror> mirrors;
    std::vector<Fixed> fixed;
  };
  template <class F>
  void for_all(int block, F&& take) const;  // take(copy) for each ghost, turned or not
  void plan_cell(const Mesh&, const std::array<Side, 4>&, int block, int i, int j);

  std::array<Side, 4> sides_;
  std::array<FlowState, 4> inflow_{};  // of each side, now
  std::vector<Plan> plans_;
};

}  // namespace couloir
