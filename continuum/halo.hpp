#pragma once
// What the ranks tell each other, so that each can fill the ghosts of its own blocks: the cells of others' blocks next to its
// own, how coarser cells slope and change, and what passed from finer ones. Nothing where a rank is alone.

#include <vector>

#include "continuum/boundary/ghosts.hpp"
#include "continuum/mesh/ranks.hpp"
#include "continuum/scheme/level_faces.hpp"

namespace couloir {

class Halo {
 public:
  Halo() = default;
  // owner: the rank of each block. given: of each block, its faces to coarser ones.
  Halo(const Mesh&, Ghosts&, const Ranks&, const std::vector<int>& owner,
       const std::vector<const std::vector<GivenFace>*>& given);

  // The state of this level's cells.
  void tell_state(int level, std::vector<BlockState>&) const;
  void tell_passive(int level, std::vector<BlockState>&) const;
  // What Ghosts::look() and look_ahead() found, for the blocks of this level.
  void tell_looks(int level, Ghosts&) const;
  // What this level's blocks take from finer ones.
  void tell_fluxes(int level, std::vector<LevelFluxes>&) const;

 private:
  struct Item {
    int block, at;  // cell, coarser cell or slot
    bool operator==(const Item&) const = default;
    auto operator<=>(const Item&) const = default;
  };
  struct Lists {  // by rank
    std::vector<std::vector<Item>> out, in;
  };
  template <class Pack, class Unpack>
  void tell(const Lists&, int numbers, Pack&&, Unpack&&) const;

  Ranks ranks_;
  std::vector<Lists> cells_, looks_, fluxes_;  // by level
};

}  // namespace couloir
