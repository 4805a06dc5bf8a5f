// What is counted on several grids: pushes on obstacles, control boxes, gauges, the budget.

#include <algorithm>

#include "continuum/noc/nested/nested_impl.hpp"

namespace couloir {
namespace {

bool same(const CellBox& a, const CellBox& b) {
  return a.i0 == b.i0 && a.i1 == b.i1 && a.j0 == b.j0 && a.j1 == b.j1;
}

}  // namespace

void NestedNoc::Impl::find_pieces(int nest, const CellBox& box, Pieces& pieces) {
  Nest& n = nests[nest];
  bool hidden = false;  // one patch covers all
  for (int child : n.children) hidden = hidden || same(nests[child].covered(box), box);
  if (!hidden) pieces.push_back({nest, n.solver.add_control_box(box), 1});
  for (int child : n.children) {
    const CellBox part = nests[child].covered(box);
    if (part.empty()) continue;
    if (!hidden) pieces.push_back({nest, n.solver.add_control_box(part), -1});
    find_pieces(child, nests[child].finer(part), pieces);
  }
}

// A face on a patch's edge is the parent's, unless it lies on the domain's side.
void NestedNoc::Impl::find_pieces(int nest, int i, int j0, int j1, Pieces& pieces, double sign) {
  Nest& n = nests[nest];
  pieces.push_back({nest, n.solver.add_gauge(i, j0, j1), sign});
  if (sign < 0) return;
  for (int child : n.children) {
    const CellBox& foot = nests[child].foot;
    const bool within = (i > foot.i0 || i == 0) && (i < foot.i1 || i == n.solver.grid().nx);
    const int low = std::max(j0, foot.j0), high = std::min(j1, foot.j1);
    if (!within || i < foot.i0 || i > foot.i1 || low >= high) continue;
    find_pieces(nest, i, low, high, pieces, -1);
    const CellBox part = nests[child].finer({i, i, low, high});
    find_pieces(child, part.i0, part.j0, part.j1, pieces);
  }
}

std::array<double, 2> NestedNoc::Impl::push(int obstacle) const {
  std::array<double, 2> sum{};
  for (const Nest& n : nests) {
    const auto part = n.solver.obstacle_impulse(obstacle);
    for (int k : {0, 1}) sum[k] += part[k];
  }
  return sum;
}

std::array<double, 2> NestedNoc::Impl::push() const {
  std::array<double, 2> sum{};
  for (int id = 0; id < obstacles; ++id) {
    const auto part = push(id);
    for (int k : {0, 1}) sum[k] += part[k];
  }
  return sum;
}

void NestedNoc::Impl::keep_books() {
  budget = base().budget();
  const auto pushed = push();
  for (int k : {0, 1}) {
    const double finest = pushed_before[k] - pushed[k];
    budget.copied[k] += budget.obstacles[k] - finest;
    budget.obstacles[k] = finest;
  }
}

void NestedNoc::Impl::visit(int nest, const CellBox& box, const std::function<void(const Sample&)>& f) const {
  const Nest& n = nests[nest];
  const Grid& g = n.solver.grid();
  const CellBox own{std::max(box.i0, n.inside.i0), std::min(box.i1, n.inside.i1), std::max(box.j0, n.inside.j0),
                    std::min(box.j1, n.inside.j1)};
  for (int j = own.j0; j < own.j1; ++j) {
    for (int i = own.i0; i < own.i1; ++i) {
      const auto hidden = [&](int child) { return nests[child].foot.contains(i, j); };
      if (std::none_of(n.children.begin(), n.children.end(), hidden)) f({g.x(i), g.y(j), n.solver.at(i, j)});
    }
  }
}

}  // namespace couloir
