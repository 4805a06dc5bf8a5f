// No depth below zero: where the four shares of a point would sum to less than nothing, the givers that take are limited until
// none of their shares is negative. What a giver holds is still given, so mass is kept.

#include <algorithm>
#include <utility>

#include "continuum/noc/noc_impl.hpp"

namespace couloir {
namespace {

using Place = std::pair<int, int>;

// The points of a box at which bad(i, j), in a fixed order.
template <class F>
std::vector<Place> find(const CellBox& box, int threads, F&& bad) {
  std::vector<std::vector<Place>> rows(std::max(box.j1 - box.j0, 0));
#pragma omp parallel for num_threads(threads) schedule(static)
  for (int j = box.j0; j < box.j1; ++j) {
    for (int i = box.i0; i < box.i1; ++i) {
      if (bad(i, j)) rows[j - box.j0].emplace_back(i, j);
    }
  }
  std::vector<Place> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace

// Limiting one giver takes from others what it gave too much; each round limits at least one more, so this ends.
void NocSolver::Impl::limit_corners(const CellBox& box) {
  for (;;) {
    const auto negative = find(box, settings.threads, [&](int i, int j) {
      const auto depth = [&](int a, int b) {
        const Giver g = giver(i, j, a, b);
        return noc::share_depth(*g.p, g.cx, g.cy);
      };
      return (depth(0, 0) + depth(0, 1)) + (depth(1, 0) + depth(1, 1)) < 0;
    });
    if (negative.empty()) return;
    for (const auto& [i, j] : negative) {
      for (int n = 0; n < 4; ++n) {
        const Giver g = giver(i, j, n / 2, n % 2);
        if (noc::share_depth(*g.p, g.cx, g.cy) < 0) limit(centres.points[g.p - centres.points.data()]);
      }
    }
  }
}

void NocSolver::Impl::limit_centres(const CellBox& box) {
  for (;;) {
    const auto negative = find(box, settings.threads, [&](int i, int j) {
      const auto depth = [&](int a, int b) { return share_to_centre(i, j, a, b); };
      return (depth(0, 0) + depth(0, 1)) + (depth(1, 0) + depth(1, 1)) < 0;
    });
    if (negative.empty()) return;
    for (const auto& [i, j] : negative) {
      for (int n = 0; n < 4; ++n) {
        if (share_to_centre(i, j, n / 2, n % 2) < 0) limit_corner(i + n / 2, j + n % 2);
      }
    }
  }
}

// And its periodic twins, which give the other half of what it holds.
void NocSolver::Impl::limit_corner(int i, int j) {
  const Grid& g = settings.grid;
  const auto twin = [](int at, int last, const Side& side) {
    return side.kind == Side::Kind::periodic && (at == 0 || at == last) ? last - at : at;
  };
  const int ti = twin(i, g.nx, settings.sides[0]), tj = twin(j, g.ny, settings.sides[2]);
  limit(corners.points[corners.at(i, j)]);
  if (ti != i) limit(corners.points[corners.at(ti, j)]);
  if (tj != j) limit(corners.points[corners.at(i, tj)]);
  if (ti != i && tj != j) limit(corners.points[corners.at(ti, tj)]);
}

void NocSolver::Impl::limit(Point& p) {
  p.keep = noc::own_keep(p);
  ++limited_count;
}

}  // namespace couloir
