#include "continuum/noc/receive.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "continuum/isa/clones.hpp"
#include "continuum/scheme/effects.hpp"

namespace couloir::noc {
namespace {

// Where the four givers of a receiver lie, and the ground of the quadrants between them; [a][b], 0 the lower one. All indices are
// those of column 0.
struct Stencil {
  int receiver;
  int giver[2][2];
  int centre;  // back to the centres: the receiver itself
  const double *weight[2], *drive[2], *kappa[2];
  const double *rise_x[2][2], *rise_y[2][2];  // null where the bed is level
};

//   centres give by their (1 - a, 1 - b)     corners give the cell's own (a, b)
//   o     o                                  +-----+
//      +                                     |  o  |
//   o     o                                  +-----+
Stencil stencil(const Lattice& to, const Lattice& from, const Terrain& t, int j, bool back) {
  Stencil s;
  const Lattice& centres = back ? to : from;
  s.receiver = to.at(0, j);
  s.centre = back ? s.receiver : 0;
  for (int a : {0, 1}) {
    const int i = back ? 0 : a - 1, quadrant_a = back ? a : 1 - a;
    const Terrain::Columns& columns = t.columns(quadrant_a);
    s.weight[a] = columns.weight.data() + Lattice::ghosts + i, s.drive[a] = columns.drive.data() + Lattice::ghosts + i;
    s.kappa[a] = columns.kappa.data() + Lattice::ghosts + i;
    for (int b : {0, 1}) {
      s.giver[a][b] = back ? from.at(a, j + b) : from.at(a - 1, j + b - 1);
      if (t.level()) continue;
      const Terrain::Slopes& slopes = t.slopes(quadrant_a, back ? b : 1 - b);
      const int cell = back ? centres.at(0, j) : centres.at(i, j + b - 1);
      s.rise_x[a][b] = slopes.x.data() + cell, s.rise_y[a][b] = slopes.y.data() + cell;
    }
  }
  return s;
}

template <bool back, bool friction, bool curved, bool relief>
COULOIR_CLONES void receive(Lattice& to, const Lattice& from, const Terrain& t, const Drag& all_drag, int j, int i0, int i1,
                            double tau, ColumnSums& sums) {
  const Stencil s = stencil(to, from, t, j, back);
  const Points points = from.points, own = to.points;
  const Drag drag{all_drag.mu, all_drag.dry, friction, curved};
  const double* locked = from.locked;
  double *h = to.q.h + s.receiver, *hu = to.q.hu + s.receiver, *hv = to.q.hv + s.receiver;
  double *lost_x = to.lost_x + s.receiver, *lost_y = to.lost_y + s.receiver;
  double* held_to = to.locked + s.receiver;
  double *gravity_x = sums.at(ColumnSums::gravity_x), *gravity_y = sums.at(ColumnSums::gravity_y);
  double *friction_x = sums.at(ColumnSums::friction_x), *friction_y = sums.at(ColumnSums::friction_y);
  double *cutoff_x = sums.at(ColumnSums::cutoff_x), *cutoff_y = sums.at(ColumnSums::cutoff_y);
  double *not_finite = sums.at(ColumnSums::not_finite), *least = sums.at(ColumnSums::least);
  const auto part = [&](int i, int a, int b) __attribute__((always_inline)) {
    const double cx = a == 0 ? 1 : -1, cy = b == 0 ? 1 : -1;
    const Point p = points.at(s.giver[a][b] + i);
    const Ground g{s.weight[a][i], s.drive[a][i], curved ? s.kappa[a][i] : 0.0, relief ? s.rise_x[a][b][i] : 0.0,
                   relief ? s.rise_y[a][b][i] : 0.0};
    Part out = part_of(p, g, drag, cx, cy, tau);
    if constexpr (back) out.h = share_back(p, own.at(s.centre + i), locked[s.giver[a][b] + i], cx, cy);
    return out;
  };
#pragma omp simd
  for (int i = i0; i < i1; ++i) {
    // Pairs across y first, then across x: mirrored scenes give mirrored bits.
    const int ll = s.giver[0][0] + i, lh = s.giver[0][1] + i, hl = s.giver[1][0] + i, hh = s.giver[1][1] + i;
    Part all = (part(i, 0, 0) + part(i, 0, 1)) + (part(i, 1, 0) + part(i, 1, 1));
    const double reach = larger(larger(points.reach[ll], points.reach[lh]), larger(points.reach[hl], points.reach[hh]));
    const double held = locked[ll] * locked[lh] * (locked[hl] * locked[hh]);
    if constexpr (back) all.h = held > 0 ? h[i] : all.h;
    const Settled out = settle(all, reach, held, drag);
    h[i] = all.h, hu[i] = out.hu, hv[i] = out.hv;
    if constexpr (!back) held_to[i] = held;
    lost_x[i] = out.friction_x + out.cutoff_x, lost_y[i] = out.friction_y + out.cutoff_y;
    gravity_x[i] += all.x, gravity_y[i] += all.y;
    friction_x[i] += out.friction_x, friction_y[i] += out.friction_y;
    cutoff_x[i] += out.cutoff_x, cutoff_y[i] += out.cutoff_y;
    const double sum = all.h + out.hu + out.hv;
    not_finite[i] += sum - sum == 0 ? 0.0 : 1.0;
    least[i] = smaller(least[i], all.h);
  }
}

// Piece by piece: where the surface has no arc and no bed rises, neither is asked for.
template <bool back>
void receive_row(Lattice& to, const Lattice& from, const Terrain& t, const Drag& drag, int j, int i0, int i1, double tau,
                 ColumnSums& sums) {
  const int more = back ? 0 : 1;  // a corner between two cells has the ground of both
  const CellBox bed = built::relief ? t.relief() : CellBox{}, arc = drag.curved ? t.arc() : CellBox{};
  const bool risen = j >= bed.j0 && j < bed.j1 + more;
  const auto within = [&](int i, const CellBox& b) { return i >= b.i0 && i < b.i1 + more && b.i0 < b.i1; };
  std::array<int, 6> cuts{i0, i1, bed.i0, bed.i1 + more, arc.i0, arc.i1 + more};
  for (int& cut : cuts) cut = std::clamp(cut, i0, std::max(i0, i1));
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const int begin = cuts[k], end = cuts[k + 1];
    if (begin >= end) continue;
    const bool relief = risen && within(begin, bed), curved = within(begin, arc);
    const auto run = [&](auto with_friction, auto with_arc) {
      relief ? receive<back, with_friction(), with_arc(), true>(to, from, t, drag, j, begin, end, tau, sums)
             : receive<back, with_friction(), with_arc(), false>(to, from, t, drag, j, begin, end, tau, sums);
    };
    if (!drag.friction) {
      run(std::false_type{}, std::false_type{});
    } else {
      curved ? run(std::true_type{}, std::true_type{}) : run(std::true_type{}, std::false_type{});
    }
  }
}

}  // namespace

void receive_at_corners(Lattice& corners, const Lattice& centres, const Terrain& t, const Drag& drag, int j, int i0, int i1,
                        double tau, ColumnSums& sums) {
  receive_row<false>(corners, centres, t, drag, j, i0, i1, tau, sums);
}

void receive_at_centres(Lattice& centres, const Lattice& corners, const Terrain& t, const Drag& drag, int j, int i0, int i1,
                        double tau, ColumnSums& sums) {
  receive_row<true>(centres, corners, t, drag, j, i0, i1, tau, sums);
}

COULOIR_CLONES double least_at_corners(const Lattice& centres, int j, int i0, int i1) {
  const Points points = centres.points;
  const int below = centres.at(0, j - 1), above = centres.at(0, j);
  double least = 0;
#pragma omp simd reduction(min : least)
  for (int i = i0; i < i1; ++i) {
    const double low = share_depth(points.at(below + i - 1), 1, 1) + share_depth(points.at(above + i - 1), 1, -1);
    const double high = share_depth(points.at(below + i), -1, 1) + share_depth(points.at(above + i), -1, -1);
    least = smaller(least, low + high);
  }
  return least;
}

COULOIR_CLONES double least_at_centres(const Lattice& centres, const Lattice& corners, int j, int i0, int i1) {
  const Points points = corners.points, own = centres.points;
  const int below = corners.at(0, j), above = corners.at(0, j + 1), cell = centres.at(0, j);
  const double* locked = corners.locked;
  double least = 0;
#pragma omp simd reduction(min : least)
  for (int i = i0; i < i1; ++i) {
    const Point p = own.at(cell + i);
    const auto share = [&](int n, double cx, double cy) __attribute__((always_inline)) {
      return share_back(points.at(n + i), p, locked[n + i], cx, cy);
    };
    least = smaller(least, (share(below, 1, 1) + share(above, 1, -1)) + (share(below + 1, -1, 1) + share(above + 1, -1, -1)));
  }
  return least;
}

void ColumnSums::clear(int nx) {
  for (auto& c : columns_) c.assign(nx, 0.0);
  std::fill(columns_[least].begin(), columns_[least].end(), std::numeric_limits<double>::infinity());
}

void ColumnSums::add_to(RowSums& rows) const {
  double sum[not_finite + 1] = {};
  for (std::size_t i = 0; i < columns_[0].size(); ++i) {
    for (int c = 0; c <= not_finite; ++c) sum[c] += columns_[c][i];
    rows.min_depth = smaller(rows.min_depth, columns_[least][i]);
  }
  Budget& b = rows.budget;
  b.gravity[0] += sum[gravity_x], b.gravity[1] += sum[gravity_y];
  b.friction[0] += sum[friction_x], b.friction[1] += sum[friction_y];
  b.cutoff[0] += sum[cutoff_x], b.cutoff[1] += sum[cutoff_y];
  rows.finite = rows.finite && sum[not_finite] == 0;
}

}  // namespace couloir::noc
