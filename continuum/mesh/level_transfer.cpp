#include "continuum/mesh/level_transfer.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {
namespace {

constexpr int along_x[] = {-1, 1, -1, 1}, along_y[] = {-1, -1, 1, 1};

// A quarter of minmod.
double quarter(double below, double above) {
  if (!(below * above > 0)) return 0;
  return 0.25 * (std::abs(below) < std::abs(above) ? below : above);
}

}  // namespace

CellSlopes slopes_of(const Fields& q, const Block& b, int c, double dry) {
  const int row = b.row();
  const int around[] = {c - 1, c + 1, c - row, c + row};
  CellSlopes s;
  if (q.h[c] < dry) return s;
  bool wet = true;
  for (int n : {c, c - 1, c + 1, c - row, c + row}) {
    wet = wet && q.h[n] >= dry;
    if (q.h[n] < dry) continue;
    s.fastest_u = std::max(s.fastest_u, std::abs(q.hu[n] / q.h[n]));
    s.fastest_v = std::max(s.fastest_v, std::abs(q.hv[n] / q.h[n]));
  }
  s.surface = wet && b.relief;
  const auto differences = [&](const std::vector<double>& w, double& x, double& y) {
    x = quarter(w[c] - w[around[0]], w[around[1]] - w[c]);
    y = quarter(w[c] - w[around[2]], w[around[3]] - w[c]);
  };
  if (s.surface) {
    const auto eta = [&](int n) { return q.h[n] + b.bed[n]; };
    s.hx = quarter(eta(c) - eta(around[0]), eta(around[1]) - eta(c));
    s.hy = quarter(eta(c) - eta(around[2]), eta(around[3]) - eta(c));
  } else {
    differences(q.h, s.hx, s.hy);
  }
  differences(q.hu, s.hux, s.huy);
  differences(q.hv, s.hvx, s.hvy);
  return s;
}

std::array<double, 2> bed_slopes_of(const Block& b, int c) {
  const int row = b.row();
  return {quarter(b.bed[c] - b.bed[c - 1], b.bed[c + 1] - b.bed[c]),
          quarter(b.bed[c] - b.bed[c - row], b.bed[c + row] - b.bed[c])};
}

std::array<FlowState, 4> children_of(const FlowState& q, double z, const CellSlopes& s, const std::array<double, 4>& bed) {
  std::array<FlowState, 4> out;
  // A bed that rises out of the surface, or slopes that were drawn when there was more, leave no depth for a child: then all get
  // the same.
  double least = 0;
  for (int k = 0; k < 4; ++k) {
    const double off = along_x[k] * s.hx + along_y[k] * s.hy;
    out[k].h = s.surface ? ((q.h + z) + off) - bed[k] : q.h + off;
    least = std::min(least, out[k].h);
  }
  if (least < 0) {
    for (FlowState& child : out) child.h = q.h;
  }
  const double u = q.h > 0 ? q.hu / q.h : 0.0, v = q.h > 0 ? q.hv / q.h : 0.0;
  bool slow_u = true, slow_v = true;
  for (int k = 0; k < 4; ++k) {
    out[k].hu = q.hu + along_x[k] * s.hux + along_y[k] * s.huy;
    out[k].hv = q.hv + along_x[k] * s.hvx + along_y[k] * s.hvy;
    slow_u = slow_u && std::abs(out[k].hu) <= s.fastest_u * (1 + 1e-9) * out[k].h;
    slow_v = slow_v && std::abs(out[k].hv) <= s.fastest_v * (1 + 1e-9) * out[k].h;
  }
  for (FlowState& child : out) {
    if (!slow_u) child.hu = u * child.h;
    if (!slow_v) child.hv = v * child.h;
  }
  return out;
}

FlowState parent_of(const Fields& q, int row, int child) {
  return {mean_of_children(q.h.data(), child, row), mean_of_children(q.hu.data(), child, row),
          mean_of_children(q.hv.data(), child, row)};
}

}  // namespace couloir
