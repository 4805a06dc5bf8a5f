#include "continuum/noc/control_box.hpp"

#include <algorithm>

#include "continuum/noc/noc_impl.hpp"

namespace couloir {
namespace noc {

BoxTerms& BoxTerms::operator+=(const BoxTerms& b) {
  for (int k : {0, 1}) faces[k] += b.faces[k], weight[k] += b.weight[k], friction[k] += b.friction[k];
  return *this;
}

namespace {

struct Momentum {
  double x = 0, y = 0;
  Momentum& operator+=(const Momentum& m) {
    x += m.x, y += m.y;
    return *this;
  }
};

// What pushes a quadrant and is no obstacle.
Momentum weight(const Point& p, const Terrain& t, int k, int l, double cx, double cy, double tau) {
  const double h = quarter_depth(p, cx, cy), part = 0.25 * tau;
  const Gradient bed = t.ground(k, l);
  return {part * h * (t.drive(k) - t.weight(k) * bed.x), part * h * (-t.weight(k) * bed.y)};
}

// Over the quadrants [a][b] of a point that belong to the box, pairs across y first.
template <class F>
Momentum over(const bool (&inside)[2][2], F&& value) {
  Momentum sum;
  for (int a : {0, 1}) {
    Momentum pair;
    for (int b : {0, 1}) {
      if (inside[a][b]) pair += value(a, b);
    }
    sum += pair;
  }
  return sum;
}

}  // namespace
}  // namespace noc

using noc::BoxTerms;
using noc::Momentum;

void NocSolver::Impl::count_box_corner(const CellBox& box, int i, int j, double tau, BoxTerms& terms) const {
  const auto giver = [&](int a, int b) { return centres.point(centres.at(i - 1 + a, j - 1 + b)); };
  bool inside[2][2];
  int count = 0;
  for (int a : {0, 1}) {
    for (int b : {0, 1}) count += inside[a][b] = box.contains(i - 1 + a, j - 1 + b);
  }
  const Momentum weight = noc::over(inside, [&](int a, int b) {
    return noc::weight(giver(a, b), terrain, 2 * i - 1 + a, 2 * j - 1 + b, 1 - 2 * a, 1 - 2 * b, tau);
  });
  const int c = corners.at(i, j);
  const double portion = 0.25 * count;
  const Momentum friction{portion * corners.lost_x[c], portion * corners.lost_y[c]};
  terms.weight[0] += weight.x, terms.weight[1] += weight.y;
  terms.friction[0] += friction.x, terms.friction[1] += friction.y;
  if (count == 4) return;
  const Momentum given = noc::over(inside, [&](int a, int b) {
    const noc::Drag none{0, settings.dry_depth, false, false};
    const noc::Part p = part_of(giver(a, b), ground(2 * i - 1 + a, 2 * j - 1 + b), none, 1 - 2 * a, 1 - 2 * b, tau);
    return Momentum{p.hu + p.x, p.hv + p.y};
  });
  terms.faces[0] -= given.x + friction.x, terms.faces[1] -= given.y + friction.y;
}

void NocSolver::Impl::count_box_centre(const CellBox& box, int i, int j, double tau, BoxTerms& terms) const {
  const auto giver = [&](int a, int b) { return corners.point(corners.at(i + a, j + b)); };
  constexpr bool all[2][2] = {{true, true}, {true, true}};
  const Momentum weight = noc::over(
      all, [&](int a, int b) { return noc::weight(giver(a, b), terrain, 2 * i + a, 2 * j + b, 1 - 2 * a, 1 - 2 * b, tau); });
  const int c = centres.at(i, j);
  terms.weight[0] += weight.x, terms.weight[1] += weight.y;
  terms.friction[0] += centres.lost_x[c], terms.friction[1] += centres.lost_y[c];
  if (i > box.i0 && i < box.i1 - 1 && j > box.j0 && j < box.j1 - 1) return;
  bool edge[2][2];
  for (int a : {0, 1}) {
    for (int b : {0, 1}) edge[a][b] = i + a == box.i0 || i + a == box.i1 || j + b == box.j0 || j + b == box.j1;
  }
  const Momentum back = noc::over(edge, [&](int a, int b) {
    const FlowState s = share(giver(a, b), 1 - 2 * a, 1 - 2 * b);
    return Momentum{s.hu, s.hv};
  });
  terms.faces[0] += back.x, terms.faces[1] += back.y;
}

// The points that the half steps update, no others: what they do to a film beyond is dropped again.
void NocSolver::Impl::count_boxes(HalfStep to, double tau) {
  const double area = settings.grid.dx * settings.grid.dy;
  const bool to_corners = to == HalfStep::to_corners;
  const int more = to_corners ? 1 : 0;
  const Region& region = to_corners ? corner_region : near;
  for (noc::ControlBox& box : boxes) {
    const CellBox& own = box.cells;
    std::vector<BoxTerms> rows(own.j1 + more - own.j0);
#pragma omp parallel for num_threads(settings.threads) schedule(static)
    for (int j = own.j0; j < own.j1 + more; ++j) {
      if (j < region.j0() || j >= region.j1()) continue;
      const int begin = std::max(own.i0, region.begin(j)), end = std::min(own.i1 + more, region.end(j));
      for (int i = begin; i < end; ++i) {
        BoxTerms& row = rows[j - own.j0];
        to_corners ? count_box_corner(own, i, j, tau, row) : count_box_centre(own, i, j, tau, row);
      }
    }
    BoxTerms sum = noc::sum_rows(rows);
    for (auto* term : {&sum.faces, &sum.weight, &sum.friction}) (*term)[0] *= area, (*term)[1] *= area;
    box.terms += sum;
  }
}

std::array<double, 2> NocSolver::Impl::momentum_in(const CellBox& box) const {
  std::vector<Momentum> rows(box.j1 - box.j0);
  for (int j = box.j0; j < box.j1; ++j) {
    for (int i = box.i0; i < box.i1; ++i) {
      const FlowState q = get(i, j);
      rows[j - box.j0] += {q.hu, q.hv};
    }
  }
  const Momentum sum = noc::sum_rows(rows);
  const double area = settings.grid.dx * settings.grid.dy;
  return {sum.x * area, sum.y * area};
}

}  // namespace couloir
