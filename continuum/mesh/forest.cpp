#include "continuum/mesh/forest.hpp"

#include <p4est.h>
#include <p4est_bits.h>
#include <p4est_extended.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "continuum/bytes.hpp"
#include "continuum/mesh/mpi_session.hpp"

namespace couloir {
namespace {

struct Callback {
  std::vector<std::pair<int, int>> tree_place;  // of each tree in the brick
  const std::function<int(const Leaf&)>*wanted = nullptr, *weight = nullptr;
  int levels = 0;

  Leaf leaf(p4est_topidx_t tree, const p4est_quadrant_t& q) const {
    const int level = q.level, length = P4EST_QUADRANT_LEN(level);
    const auto [tx, ty] = tree_place[tree];
    return {level, (tx << level) + q.x / length, (ty << level) + q.y / length};
  }
};

Callback& callback(p4est_t* forest) {
  return *static_cast<Callback*>(forest->user_pointer);
}

int refine(p4est_t* forest, p4est_topidx_t tree, p4est_quadrant_t* q) {
  const Callback& c = callback(forest);
  return q->level < c.levels && (*c.wanted)(c.leaf(tree, *q)) > q->level;
}

int coarsen(p4est_t* forest, p4est_topidx_t tree, p4est_quadrant_t* children[]) {
  const Callback& c = callback(forest);
  for (int k = 0; k < P4EST_CHILDREN; ++k) {
    if (!children[k] || (*c.wanted)(c.leaf(tree, *children[k])) >= children[k]->level) return 0;
  }
  return 1;
}

int weigh(p4est_t* forest, p4est_topidx_t tree, p4est_quadrant_t* q) {
  const Callback& c = callback(forest);
  return (*c.weight)(c.leaf(tree, *q));
}

}  // namespace

struct Forest::Impl {
  Ranks ranks;
  Callback callback;
  p4est_connectivity_t* brick = nullptr;
  p4est_t* forest = nullptr;
  ~Impl() {
    if (forest) p4est_destroy(forest);
    if (brick) p4est_connectivity_destroy(brick);
  }
};

Forest::Forest(int blocks_x, int blocks_y, bool periodic_x, bool periodic_y, int levels, const Ranks& ranks)
    : impl_(std::make_unique<Impl>()) {
  use_mpi();
  Impl& m = *impl_;
  m.brick = p4est_connectivity_new_brick(blocks_x, blocks_y, periodic_x, periodic_y);
  m.ranks = ranks;
  m.callback.levels = levels;
  for (p4est_topidx_t t = 0; t < m.brick->num_trees; ++t) {
    const double* corner = m.brick->vertices + 3 * m.brick->tree_to_vertex[P4EST_CHILDREN * t];
    m.callback.tree_place.emplace_back(static_cast<int>(corner[0]), static_cast<int>(corner[1]));
  }
  m.forest = p4est_new(ranks.alone() ? sc_MPI_COMM_SELF : sc_MPI_COMM_WORLD, m.brick, 0, nullptr, &m.callback);
  read_leaves();
}

Forest::~Forest() = default;

bool Forest::adapt(const std::function<int(const Leaf&)>& wanted_level) {
  Impl& m = *impl_;
  const std::vector<Leaf> before = leaves_;
  m.callback.wanted = &wanted_level;
  p4est_coarsen(m.forest, 0, coarsen, nullptr);
  p4est_refine(m.forest, 0, refine, nullptr);
  p4est_balance(m.forest, P4EST_CONNECT_FULL, nullptr);
  m.callback.wanted = nullptr;
  read_leaves();
  return leaves_ != before;
}

void Forest::become(const std::vector<Leaf>& leaves) {
  std::set<std::tuple<int, int, int>> parents;  // of what is to be there, at all levels
  for (const Leaf& leaf : leaves) {
    for (Leaf a = leaf; a.level > 0;) {
      a = {a.level - 1, a.bi >> 1, a.bj >> 1};
      parents.insert({a.level, a.bi, a.bj});
    }
  }
  const auto wanted = [&](const Leaf& l) {
    return parents.count({l.level, l.bi, l.bj})                                 ? l.level + 1
           : l.level > 0 && !parents.count({l.level - 1, l.bi >> 1, l.bj >> 1}) ? l.level - 1
                                                                                : l.level;
  };
  while (adapt(wanted)) {
  }
}

void Forest::deal(const std::function<int(const Leaf&)>& weight) {
  Impl& m = *impl_;
  m.callback.weight = &weight;
  p4est_partition(m.forest, 1, weigh);
  m.callback.weight = nullptr;
  read_leaves();
}

void Forest::read_leaves() {
  ByteWriter own;
  const p4est_t& f = *impl_->forest;
  for (p4est_topidx_t t = f.first_local_tree; t <= f.last_local_tree; ++t) {
    p4est_tree_t* tree = p4est_tree_array_index(f.trees, t);
    for (std::size_t k = 0; k < tree->quadrants.elem_count; ++k) {
      own(impl_->callback.leaf(t, *p4est_quadrant_array_index(&tree->quadrants, k)));
      own(impl_->ranks.mine());
    }
  }
  const std::vector<std::uint8_t> bytes = impl_->ranks.gather(own.bytes);
  leaves_.clear(), owners_.clear();
  for (ByteReader all(bytes); !all.done();) {
    leaves_.push_back(all.take<Leaf>());
    owners_.push_back(all.take<int>());
  }
}

}  // namespace couloir
