// No depth below zero: where the four shares of a point would sum to less than nothing, the givers that take are limited until
// none of their shares is negative. What a giver holds is still given, so mass is kept.

#include <algorithm>
#include <utility>

#include "continuum/noc/noc_impl.hpp"

namespace couloir {
namespace {

using Place = std::pair<int, int>;

// The points of the rows at which negative(j, places) finds some, in a fixed order.
template <class F>
std::vector<Place> find(const noc::Region& region, int threads, F&& negative) {
  std::vector<std::vector<Place>> rows(std::max(region.j1() - region.j0(), 0));
#pragma omp parallel for num_threads(threads) schedule(static)
  for (int j = region.j0(); j < region.j1(); ++j) negative(j, rows[j - region.j0()]);
  std::vector<Place> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace

double NocSolver::Impl::depth_at_corner(int i, int j) const {
  const auto depth = [&](int a, int b) {
    const Giver g = giver(i, j, a, b);
    return noc::share_depth(g.p, g.cx, g.cy);
  };
  return (depth(0, 0) + depth(0, 1)) + (depth(1, 0) + depth(1, 1));
}

double NocSolver::Impl::depth_at_centre(int i, int j) const {
  const auto depth = [&](int a, int b) { return share_to_centre(i, j, a, b); };
  return (depth(0, 0) + depth(0, 1)) + (depth(1, 0) + depth(1, 1));
}

// Limiting one giver takes from others what it gave too much; each round limits at least one more, so this ends.
void NocSolver::Impl::limit_corners() {
  for (;;) {
    const auto negative = find(corner_region, settings.threads, [&](int j, std::vector<Place>& places) {
      const auto look = [&](int i) {
        if (depth_at_corner(i, j) < 0) places.emplace_back(i, j);
      };
      const auto [low, high] = inner(corner_region, j);
      if (least_at_corners(centres, j, low, high) < 0) {
        for (int i = low; i < high; ++i) look(i);
      }
      for_outer(corner_region, j, look);
    });
    if (negative.empty()) return;
    for (const auto& [i, j] : negative) {
      for (int n = 0; n < 4; ++n) {
        const Giver g = giver(i, j, n / 2, n % 2);
        if (noc::share_depth(g.p, g.cx, g.cy) < 0) limit(centres, g.source);
      }
    }
    centres.wrap_points();
  }
}

void NocSolver::Impl::limit_centres() {
  for (;;) {
    const auto negative = find(near, settings.threads, [&](int j, std::vector<Place>& places) {
      if (least_at_centres(centres, corners, j, near.begin(j), near.end(j)) >= 0) return;
      for (int i = near.begin(j); i < near.end(j); ++i) {
        if (depth_at_centre(i, j) < 0) places.emplace_back(i, j);
      }
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
  limit(corners, corners.at(i, j));
  if (ti != i) limit(corners, corners.at(ti, j));
  if (tj != j) limit(corners, corners.at(i, tj));
  if (ti != i && tj != j) limit(corners, corners.at(ti, tj));
}

void NocSolver::Impl::limit(Lattice& lattice, int point) {
  const double keep = noc::own_keep(lattice.point(point));
  for (const noc::Three& tilt : {lattice.points.tilt_x, lattice.points.tilt_y}) {
    tilt.h[point] *= keep, tilt.hu[point] *= keep, tilt.hv[point] *= keep;
  }
  ++limited_count;
}

}  // namespace couloir
