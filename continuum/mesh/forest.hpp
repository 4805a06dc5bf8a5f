#pragma once
// Which blocks there are: the leaves of a p4est forest (Burstedde et al. 2011). A tree of the brick is a block of the coarsest
// grid; its four children have as many cells each, half as long. Blocks that touch, over a corner too, differ by one level at
// most.

#include <functional>
#include <memory>
#include <vector>

#include "continuum/mesh/grid.hpp"
#include "continuum/mesh/ranks.hpp"

namespace couloir {

struct Leaf {
  int level = 0;
  int bi = 0, bj = 0;  // place among the blocks of its level
  bool operator==(const Leaf&) const = default;
};

// All ranks must call its functions together, and get the same.
class Forest {
 public:
  // A brick of blocks_x x blocks_y trees; levels: how deep it may grow.
  Forest(int blocks_x, int blocks_y, bool periodic_x, bool periodic_y, int levels, const Ranks& = {});
  ~Forest();

  // In the order of the Morton curve.
  const std::vector<Leaf>& leaves() const { return leaves_; }

  // Grows and cuts each leaf by at most one level towards the level wanted there, as far as the balance of 2:1 allows; four
  // children are cut only together. Returns whether anything has changed.
  bool adapt(const std::function<int(const Leaf&)>& wanted_level);

  // Deals the leaves out among the ranks, each a stretch of the Morton curve of about the same sum of weights; four children stay
  // together.
  void deal(const std::function<int(const Leaf&)>& weight);
  const std::vector<int>& owners() const { return owners_; }  // ranks, of each leaf

  // The leaves as they were told before.
  void become(const std::vector<Leaf>&);

 private:
  struct Impl;
  void read_leaves();

  std::unique_ptr<Impl> impl_;
  std::vector<Leaf> leaves_;
  std::vector<int> owners_;
};

}  // namespace couloir
